//! One file a scene; only scenes know more than one renderer.

/// A scene of the command line.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Name on the command line.
    pub name: &'static str,
    /// One line for `--list`.
    pub about: &'static str,
    /// Length in seconds; playing loops after it.
    pub duration: f64,
}

/// The intro's own show: what plays when no scene is named.
pub const INTRO: Scene = Scene { name: "intro", about: "the show", duration: 60.0 };

/// Every scene, the intro's own first.
pub fn all() -> Vec<Scene> {
    vec![INTRO, Scene { name: "spheres", about: "bench", duration: 20.0 }]
}

/// The scene of that name.
pub fn named(name: &str) -> Option<Scene> {
    all().into_iter().find(|s| s.name == name)
}
