include!("../model.rs");

fn main() {
    each_size(&["--format", "od"], "od.yaml", |directory, model| {
        od_gen::Builder::new(model).device("controller").out_dir(directory).generate();
    });
}
