//! Dictionaries of the scaled model, one module for each number of objects. What a program does not use, the linker drops.
#![no_std]

/// The communication objects and 10 others: the smallest that there is.
pub mod scaled10 {
    include!(concat!(env!("OUT_DIR"), "/scaled10/controller.rs"));
}

/// 150 objects.
pub mod scaled150 {
    include!(concat!(env!("OUT_DIR"), "/scaled150/controller.rs"));
}

/// 150 objects, and those of all services.
pub mod full150 {
    include!(concat!(env!("OUT_DIR"), "/full150/controller.rs"));
}

/// 2,000 objects.
pub mod scaled2000 {
    include!(concat!(env!("OUT_DIR"), "/scaled2000/controller.rs"));
}
