//! The ray tracer: shapes against crossings without rounding, light against closed forms and the plain recursion, and the
//! adaptive picture against every pixel traced.

mod adaptive;
mod bounds;
mod fresnel;
mod shapes;
mod whitted;
