include!("../model.rs");

fn main() {
    each_size(&["--format", "toml"], "toml", |directory, model| {
        zencan_build::compile_device_config(model, directory.join("dictionary.rs"))
            .expect("zencan takes the model");
    });
}
