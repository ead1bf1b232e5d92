//! The scenes: the show and its parts as films, their meshes, and the bench scenes against a second writing of their text.

mod bench_set;
mod clouds;
mod day;
mod mesh;
mod part;
mod show;
mod snowfall;
mod torches;
