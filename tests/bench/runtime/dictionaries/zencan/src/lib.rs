//! What zencan-build generates from the scaled model.

#[cfg(feature = "size150")]
pub mod size150 {
    include!(concat!(env!("OUT_DIR"), "/size150/dictionary.rs"));
}

#[cfg(feature = "size2000")]
pub mod size2000 {
    include!(concat!(env!("OUT_DIR"), "/size2000/dictionary.rs"));
}

#[cfg(feature = "size10000")]
pub mod size10000 {
    include!(concat!(env!("OUT_DIR"), "/size10000/dictionary.rs"));
}

#[cfg(feature = "gappy150")]
pub mod gappy150 {
    include!(concat!(env!("OUT_DIR"), "/gappy150/dictionary.rs"));
}

#[cfg(feature = "gappy2000")]
pub mod gappy2000 {
    include!(concat!(env!("OUT_DIR"), "/gappy2000/dictionary.rs"));
}

#[cfg(feature = "pmc")]
pub mod pmc {
    include!(concat!(env!("OUT_DIR"), "/pmc/dictionary.rs"));
}

#[cfg(feature = "pmm")]
pub mod pmm {
    include!(concat!(env!("OUT_DIR"), "/pmm/dictionary.rs"));
}
