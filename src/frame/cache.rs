//! What a renderer keeps from frame to frame.
//!
//! Shadow maps, imposters and scratch memory belong to one [`Renderer`](super::Renderer), so that two renderers in one
//! process do not see each other. Nothing that is kept changes a frame: it only saves the time to compute it again.

use std::any::{Any, TypeId};
#[cfg(not(feature = "full"))]
use std::mem::ManuallyDrop;
#[cfg(feature = "full")]
use std::sync::Arc;
use std::sync::{Mutex, MutexGuard, PoisonError};

// What values are kept in, and what handles are made of. The 64 kB build has one renderer, for as long as it runs, so it
// counts no handles, and has no code to drop a value: 0.5 kB packed.
#[cfg(feature = "full")]
type Value<T> = Mutex<T>;
#[cfg(feature = "full")]
type Shared<T> = Arc<T>;
#[cfg(not(feature = "full"))]
type Value<T> = ManuallyDrop<Mutex<T>>;
#[cfg(not(feature = "full"))]
type Shared<T> = &'static T;

/// A handle on a value of a [`Cache`], which a layer holds while it is drawn.
pub struct Kept<T: 'static>(Shared<Value<T>>);

impl<T> Kept<T> {
    /// The value, for this thread alone. A panic of another thread has left it intact, as values are only ever replaced as
    /// a whole.
    pub fn lock(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A handle on a value of any type.
type Handle = Shared<dyn Any + Send + Sync>;

/// A new value of a type.
fn new<T: Default + Send + 'static>() -> Handle {
    #[cfg(feature = "full")]
    return Arc::<Value<T>>::default();
    #[cfg(not(feature = "full"))]
    return Box::leak(Box::<Value<T>>::default());
}

/// One value of each type that asks for a place here.
#[derive(Default)]
pub struct Cache(Mutex<Vec<Handle>>);

impl Cache {
    /// This cache's value of type `T`, which starts as the default. Every later call gives the same one.
    pub fn get<T: Default + Send + 'static>(&self) -> Kept<T> {
        let handle = self.find(TypeId::of::<Value<T>>(), new::<T>);
        #[cfg(feature = "full")]
        let value = handle.downcast().ok();
        #[cfg(not(feature = "full"))]
        let value = handle.downcast_ref();
        Kept(value.expect("a value of that type"))
    }

    /// The handle on the value of a type, which is made if there is none. Apart from [`Cache::get`], which is compiled for
    /// each type: 0.2 kB packed.
    #[inline(never)]
    fn find(&self, id: TypeId, make: fn() -> Handle) -> Handle {
        let mut handles = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for handle in &*handles {
            if (**handle).type_id() == id {
                return Shared::clone(handle);
            }
        }
        let handle = make();
        handles.push(Shared::clone(&handle));
        handle
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
