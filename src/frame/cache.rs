//! What a renderer keeps from frame to frame.
//!
//! Shadow maps, imposters and scratch memory belong to one [`Renderer`](super::Renderer), so that two renderers in one
//! process do not see each other. Nothing that is kept changes a frame: it only saves the time to compute it again.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// One value of each type that asks for a place here.
#[derive(Default)]
pub struct Cache(Mutex<Vec<Box<dyn Any + Send>>>);

impl Cache {
    /// This cache's value of type `T`, which starts as the default. Every later call gives the same one.
    pub fn get<T: Default + Send + 'static>(&self) -> Arc<Mutex<T>> {
        let mut values = lock(&self.0);
        for value in values.iter() {
            if let Some(value) = value.downcast_ref::<Arc<Mutex<T>>>() {
                return value.clone();
            }
        }
        let value = Arc::<Mutex<T>>::default();
        values.push(Box::new(value.clone()));
        value
    }
}

/// Locks what a panic elsewhere leaves intact: values are only ever replaced as a whole.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_type_has_one_value_per_cache() {
        let (one, other) = (Cache::default(), Cache::default());
        *lock(&one.get::<u32>()) = 5;
        *lock(&one.get::<u64>()) = 6;
        assert_eq!((*lock(&one.get::<u32>()), *lock(&one.get::<u64>())), (5, 6));
        assert_eq!(*lock(&other.get::<u32>()), 0);
    }
}
