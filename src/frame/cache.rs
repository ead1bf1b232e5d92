//! What a renderer keeps from frame to frame.
//!
//! Shadow maps, imposters and scratch memory belong to one [`Renderer`](super::Renderer), so that two renderers in one
//! process do not see each other. Nothing that is kept changes a frame: it only saves the time to compute it again.
//!
//! The 64 kB build has one renderer, for as long as it runs, so there each value is a static of its own: no handles, no
//! code to drop a value, and no numbers of types, which are noise to a packer and other ones in every directory.

use std::sync::{Mutex, MutexGuard, PoisonError};
#[cfg(feature = "full")]
use std::{any::Any, sync::Arc};

/// What a [`Cache`] can keep; `keep!` makes a type one of these.
pub trait Keep: Send + Sized + 'static {
    /// What it starts as.
    const NEW: Self;

    /// The only value of the process.
    #[cfg(not(feature = "full"))]
    fn only() -> &'static Mutex<Self>;
}

/// Has caches keep values of a type, which start as the second argument, a constant.
macro_rules! keep {
    ($kept:ty, $new:expr) => {
        impl $crate::frame::cache::Keep for $kept {
            const NEW: Self = $new;

            #[cfg(not(feature = "full"))]
            fn only() -> &'static std::sync::Mutex<Self> {
                static ONLY: std::sync::Mutex<$kept> = std::sync::Mutex::new($new);
                &ONLY
            }
        }
    };
}
pub(crate) use keep;

/// What handles are made of.
#[cfg(feature = "full")]
type Shared<T> = Arc<T>;
#[cfg(not(feature = "full"))]
type Shared<T> = &'static T;

/// A handle on a value of a [`Cache`], which a layer holds while it is drawn.
pub struct Kept<T: 'static>(Shared<Mutex<T>>);

impl<T> Kept<T> {
    /// The value, for this thread alone. A panic of another thread has left it intact, as values are only ever replaced as
    /// a whole.
    pub fn lock(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// One value of each type that asks for a place here.
#[derive(Default)]
pub struct Cache(#[cfg(feature = "full")] Mutex<Vec<Arc<dyn Any + Send + Sync>>>);

impl Cache {
    /// This cache's value of type `T`, which starts as [`Keep::NEW`]. Every later call gives the same one.
    #[cfg(feature = "full")]
    pub fn get<T: Keep>(&self) -> Kept<T> {
        let mut values = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let found = values.iter().find_map(|value| value.clone().downcast().ok());
        Kept(found.unwrap_or_else(|| {
            let new = Arc::new(Mutex::new(T::NEW));
            values.push(new.clone());
            new
        }))
    }

    /// The value of type `T`.
    #[cfg(not(feature = "full"))]
    pub fn get<T: Keep>(&self) -> Kept<T> {
        Kept(T::only())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    keep!(u32, 3);
    keep!(u64, 4);

    #[test]
    fn each_type_has_one_value_per_cache() {
        let (one, other) = (Cache::default(), Cache::default());
        *one.get::<u32>().lock() = 5;
        assert_eq!((*one.get::<u32>().lock(), *one.get::<u64>().lock()), (5, 4));
        *one.get::<u64>().lock() = 6;
        assert_eq!((*one.get::<u32>().lock(), *one.get::<u64>().lock()), (5, 6));
        assert_eq!(*other.get::<u32>().lock(), 3);
    }
}
