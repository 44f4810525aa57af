//! Hands `memory.x` and the linker script of `cortex-m-rt` to the linker.

fn main() {
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rustc-link-search={}", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    // cortex-m-rt: else the GNU linker may align sections to 64 KiB pages.
    println!("cargo::rustc-link-arg-bins=--nmagic");
}
