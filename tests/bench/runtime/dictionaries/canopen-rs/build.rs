include!("../model.rs");

use canopen_host::codegen::generate_object_dictionary;
use canopen_host::eds::Eds;

fn main() {
    each_size(&["--format", "eds"], "eds", |directory, model| {
        let eds = Eds::from_file(model).expect("canopen-host reads the model");
        let code = generate_object_dictionary(&eds, "device_od");
        std::fs::write(directory.join("dictionary.rs"), code).expect("OUT_DIR is writable");
    });
}
