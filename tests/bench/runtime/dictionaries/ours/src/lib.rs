//! What od-gen generates from the scaled model.

#[cfg(feature = "size150")]
pub mod size150 {
    include!(concat!(env!("OUT_DIR"), "/size150/controller.rs"));
}

#[cfg(feature = "size2000")]
pub mod size2000 {
    include!(concat!(env!("OUT_DIR"), "/size2000/controller.rs"));
}

#[cfg(feature = "size10000")]
pub mod size10000 {
    include!(concat!(env!("OUT_DIR"), "/size10000/controller.rs"));
}
