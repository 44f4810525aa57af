//! A build script to be run by tests: `build-script SPECIFICATION DEVICE OUT`; an empty device means all.

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [specification, device, out] = arguments.as_slice() {
        let builder = od_gen::Builder::new(specification.as_str()).out_dir(out);
        let builder = if device.is_empty() { builder } else { builder.device(device.as_str()) };
        builder.generate();
    }
}
