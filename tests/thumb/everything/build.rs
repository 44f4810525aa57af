//! Makes the dictionary with every data type, and hands the linker scripts to the linker.

fn main() {
    od_gen::Builder::new("../../readers/everything.od.yaml").generate();
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=../firmware/memory.x");
    println!("cargo::rustc-link-search={}/../firmware", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    // cortex-m-rt: else the GNU linker may align sections to 64 KiB pages.
    println!("cargo::rustc-link-arg-bins=--nmagic");
}
