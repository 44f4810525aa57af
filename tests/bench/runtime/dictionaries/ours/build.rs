include!("../model.rs");

fn main() {
    each_size(&["--format", "od"], "od.yaml", |directory, model| {
        // Not `generate`: cargo would run this script whenever the model has changed, which it writes itself.
        let builder = od_gen::Builder::new(model).device("controller").out_dir(directory);
        builder.try_generate().expect("od-gen takes the model");
    });
}
