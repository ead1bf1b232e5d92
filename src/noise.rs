//! Perlin's improved noise (2002).
