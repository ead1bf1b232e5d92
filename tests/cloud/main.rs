//! Clouds against analytic transmittance, marches in f64 and what the bench scenes specify.

mod imposters;
mod layer;
mod light;
mod march;
