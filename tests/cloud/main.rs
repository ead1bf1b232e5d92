//! Clouds against analytic transmittance, marches in f64 and what the bench scenes specify.

#[path = "cloud/layer.rs"]
mod layer;
#[path = "cloud/light.rs"]
mod light;
#[path = "cloud/march.rs"]
mod march;
#[path = "cloud/oracle.rs"]
mod oracle;

mod common;
