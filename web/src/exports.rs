//! The functions that the module exports. They take and give numbers; what is longer lies in the module's memory, at
//! [`output`] after a call that says how long it is, and at [`input`] before one that reads it.
//!
//! A name that the linker keeps is what Rust calls unsafe here, since two functions of one name would be undefined
//! behaviour; nothing else in this crate is.
#![allow(unsafe_code, reason = "names of exports: the linker would refuse two of one name")]

use crate::describe::description;
use crate::governor::{EIGHTHS, Governor};
use crate::rows::{Request, Rows};
use paprsek::scenes::show::score::score;
use paprsek::sound::{Pair, Score};
use std::cell::RefCell;

/// What one instance has.
struct Instance {
    rows: Option<Rows>,
    governor: Governor,
    /// Values of parameters that the next rows are rendered with.
    values: Vec<f64>,
    /// The show's score, from the first sample on that is asked for.
    score: Option<Score>,
    /// The last samples.
    samples: Vec<Pair>,
    /// The bytes of the last text.
    text: Vec<u8>,
    /// Where the result of the last call lies in memory.
    output: usize,
}

thread_local! {
    static INSTANCE: RefCell<Instance> = RefCell::new(Instance {
        rows: Rows::new().ok(),
        governor: Governor::new(),
        values: Vec::new(),
        score: None,
        samples: Vec::new(),
        text: Vec::new(),
        output: 0,
    });
}

/// Makes room for that many values of parameters, and gives the address where they are to be written as f64.
#[unsafe(no_mangle)]
pub extern "C" fn input(values: usize) -> usize {
    INSTANCE.with_borrow_mut(|instance| {
        instance.values.clear();
        instance.values.resize(values, f64::NAN);
        instance.values.as_mut_ptr() as usize
    })
}

/// The address of the last result.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> usize {
    INSTANCE.with_borrow(|instance| instance.output)
}

/// Describes in JSON what there is to choose from. Gives the length of the text in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn describe() -> usize {
    INSTANCE.with_borrow_mut(|instance| {
        let simd = instance.rows.as_ref().map_or("", Rows::simd);
        instance.text = description(simd).to_string().into_bytes();
        instance.output = instance.text.as_ptr() as usize;
        instance.text.len()
    })
}

/// Renders rows `first` to `last`, the latter not among them, of a frame: see [`Request`]. The values of parameters are
/// those at [`input`]. Gives the number of pixels, of four bytes each; 0 where there is no such scene or quality.
#[unsafe(no_mangle)]
pub extern "C" fn render(
    scene: usize,
    time: f64,
    width: usize,
    height: usize,
    quality: usize,
    first: usize,
    last: usize,
) -> usize {
    INSTANCE.with_borrow_mut(|instance| {
        let values = instance.values.clone();
        let request = Request { scene, time, size: (width, height), quality, values };
        let Some(rows) = &mut instance.rows else { return 0 };
        let pixels = rows.render(&request, first, last);
        instance.output = pixels.as_ptr() as usize;
        pixels.len()
    })
}

/// Computes so many samples of the show's sound from number `first` on: for each 16 bits for the left and 16 for the right
/// ear. Gives how many there are.
#[unsafe(no_mangle)]
pub extern "C" fn sound(first: f64, count: usize) -> usize {
    INSTANCE.with_borrow_mut(|instance| {
        instance.samples.resize(count, [0; 2]);
        instance.score.get_or_insert_with(score).samples(first as u64, &mut instance.samples);
        instance.output = instance.samples.as_ptr() as usize;
        count
    })
}

/// Takes note of a frame that took this share of its time, and gives the size of the next ones in eighths of each side.
#[unsafe(no_mangle)]
pub extern "C" fn govern(share: f64) -> usize {
    INSTANCE.with_borrow_mut(|instance| {
        instance.governor.record(share);
        EIGHTHS[instance.governor.step]
    })
}

/// Begins with the whole size again.
#[unsafe(no_mangle)]
pub extern "C" fn forget() {
    INSTANCE.with_borrow_mut(|instance| instance.governor = Governor::new());
}
