//! What Paprsek's tests, benches and report share: oracles, pictures and metrics, and running the program.
