//! What a renderer keeps from frame to frame.
//!
//! Shadow maps, imposters and scratch memory belong to one [`Renderer`](super::Renderer), so that two renderers in one
//! process do not see each other. Nothing that is kept changes a frame: it only saves the time to compute it again.

use std::any::{Any, TypeId};
#[cfg(feature = "full")]
use std::sync::Arc;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A handle on a value of a [`Cache`], which a layer holds while it is drawn.
#[cfg(feature = "full")]
#[derive(Default)]
pub struct Kept<T: 'static>(Arc<Mutex<T>>);

/// A handle on a value of a [`Cache`], which a layer holds while it is drawn. The 64 kB build has one renderer, for as long
/// as it runs, so it counts no handles and never gives a value back: 0.3 kB packed.
#[cfg(not(feature = "full"))]
pub struct Kept<T: 'static>(&'static Mutex<T>);

#[cfg(not(feature = "full"))]
impl<T: Default> Default for Kept<T> {
    fn default() -> Kept<T> {
        Kept(Box::leak(Box::default()))
    }
}

impl<T> Clone for Kept<T> {
    fn clone(&self) -> Kept<T> {
        Kept(Clone::clone(&self.0))
    }
}

impl<T> Kept<T> {
    /// The value, for this thread alone. A panic of another thread has left it intact, as values are only ever replaced as
    /// a whole.
    pub fn lock(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A handle of any type.
type Handle = Box<dyn Any + Send>;

/// One value of each type that asks for a place here.
#[derive(Default)]
pub struct Cache(Mutex<Vec<Handle>>);

impl Cache {
    /// This cache's value of type `T`, which starts as the default. Every later call gives the same one.
    pub fn get<T: Default + Send + 'static>(&self) -> Kept<T> {
        let (handles, at) = self.find(TypeId::of::<Kept<T>>(), || Box::new(Kept::<T>::default()));
        handles[at].downcast_ref::<Kept<T>>().expect("a handle of that type").clone()
    }

    /// Where the handle of a type is, which is made if there is none. Apart from [`Cache::get`], which is compiled for each
    /// type: 0.2 kB packed.
    #[inline(never)]
    fn find(&self, id: TypeId, make: fn() -> Handle) -> (MutexGuard<'_, Vec<Handle>>, usize) {
        let mut handles = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut at = 0;
        while at < handles.len() && (*handles[at]).type_id() != id {
            at += 1;
        }
        if at == handles.len() {
            handles.push(make());
        }
        (handles, at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_type_has_one_value_per_cache() {
        let (one, other) = (Cache::default(), Cache::default());
        *one.get::<u32>().lock() = 5;
        *one.get::<u64>().lock() = 6;
        assert_eq!((*one.get::<u32>().lock(), *one.get::<u64>().lock()), (5, 6));
        assert_eq!(*other.get::<u32>().lock(), 0);
    }
}
