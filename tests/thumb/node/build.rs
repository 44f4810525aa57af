//! Makes the dictionaries, and hands the linker scripts to the linker.

fn main() {
    let devices = "../../../od-spec/devices";
    for (specification, key) in [
        ("../../readers/everything.od.yaml".to_owned(), "everything"),
        (format!("{devices}/fullmo-drive.od.yaml"), "fullmo"),
        (format!("{devices}/pitch-control-system.od.yaml"), "pmm"),
    ] {
        od_gen::Builder::new(specification).device(key).generate();
    }
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=../firmware/memory.x");
    println!("cargo::rustc-link-search={}/../firmware", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    // cortex-m-rt: else the GNU linker may align sections to 64 KiB pages.
    println!("cargo::rustc-link-arg-bins=--nmagic");
}
