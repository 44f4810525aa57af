//! Makes the dictionary of its specification, and hands `memory.x` and the linker script of `cortex-m-rt` to the linker.

fn main() {
    // OUT_DIR/pmc.rs. For a firmware of your own, the path of your own `*.od.yaml`.
    od_gen::Builder::new("../../../od-spec/devices/pitch-control-system.od.yaml").device("pmc").generate();

    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rustc-link-search={}", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    // cortex-m-rt: else the GNU linker may align sections to 64 KiB pages.
    println!("cargo::rustc-link-arg-bins=--nmagic");
}
