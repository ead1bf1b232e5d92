//! What is in the air.

pub mod fog;
