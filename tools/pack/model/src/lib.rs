//! The context-mixing model that packing and unpacking share: every probability the one computes,
//! the other must compute again, so there is one source of it. Integers only, no allocation, no `std`.
//!
//! Many contexts, each a subset of a few features of what came before ([`features`]), look up adaptive
//! probabilities ([`slot`]); three mixers weigh them, a fourth weighs the mixers ([`mix`]), and a correction
//! by context follows. The method is that of Mahoney's PAQ; that the parser of x86 sits inside the model,
//! instead of streams split by a filter, is that of its executable models.
#![no_std]

pub mod address;
pub mod coder;
pub mod features;
pub mod mix;
pub mod model;
pub mod parse;
pub mod slot;
pub mod tuned;
