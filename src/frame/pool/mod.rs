//! Threads that work on a frame together.
//!
//! There are two pools with the same interface: rayon's threads, which stay and wait for the next frame, and the 64 kB
//! build's, which live for one piece of work. Either runs the same function on several threads at once and sums what
//! they return; [`crate::frame::Workers`] makes of that a queue of jobs.

#[cfg(feature = "rayon")]
mod rayon;
#[cfg(not(feature = "rayon"))]
mod scoped;
mod start;

#[cfg(feature = "rayon")]
pub use self::rayon::{Pool, cores};
#[cfg(not(feature = "rayon"))]
pub use scoped::{Pool, cores};
pub use start::start;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_are_as_many_as_there_is_work_for() {
        let pool = Pool::new(8).unwrap();
        assert_eq!([0, 1, 2, 8, 99].map(|most| pool.sum(most, &|| 1)), [1, 1, 2, 8, 8]);
    }
}
