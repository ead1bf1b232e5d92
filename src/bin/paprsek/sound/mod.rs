//! The sound of the show: played while the show plays, or saved beside a capture.
//!
//! The sound leads. What a sound card plays in a second is not quite a second by the processor's clock, and a gap or a
//! jump is heard sooner than a frame that comes a little late. So the clock of the picture follows what is heard, and
//! where one pauses or seeks the sound goes to where the clock is.

#[cfg(unix)]
mod pulse;
mod wav;

pub use wav::save;

#[cfg(unix)]
use paprsek::scenes::show::score::score;
#[cfg(unix)]
use paprsek::sound::{Pair, RATE};
#[cfg(unix)]
use pulse::Stream;
#[cfg(unix)]
use std::time::{Duration, Instant};

/// How far the sound may be from the clock before it jumps, seconds: less is made up for by the clock.
#[cfg(unix)]
const APART: f64 = 0.06;
/// The most samples that are sent at once.
#[cfg(unix)]
const PIECE: usize = 512;
/// How often the server is asked what is heard.
#[cfg(unix)]
const ASK: Duration = Duration::from_millis(100);
/// The most that is sent ahead of what a second takes, in bytes: a server that asks for more does not play.
#[cfg(unix)]
const AHEAD: f64 = 1e6;

/// Plays the show until the server goes. Without one it returns at once: the show plays on in silence, and nobody is
/// told.
///
/// `clock` is told the time of the show that is heard, if that is known, and says what time it is and whether time rests;
/// no time past the end.
#[cfg(unix)]
pub fn play(clock: &dyn Fn(Option<f64>) -> (Option<f64>, bool)) {
    let Some(mut stream) = Stream::open() else { return };
    let mut score = score();
    let rate = f64::from(RATE);
    // The next sample of the show, and how many were sent since the sound has jumped.
    let (mut next, mut since) = (0, 0);
    let began = Instant::now();
    let mut asked = began;
    let mut samples: [Pair; PIECE] = [[0; 2]; PIECE];
    loop {
        let Some(news) = stream.listen() else { return };
        let mut heard = None;
        // What was heard when the server answered, unless that was before the jump.
        if let Some(delay) = news.delay
            && (since as f64) > delay * rate
        {
            heard = Some(next as f64 / rate - delay);
        }
        let (now, rests) = clock(heard);
        if asked.elapsed() > ASK {
            asked = Instant::now();
            if stream.ask().is_none() {
                return;
            }
        }
        let fair = began.elapsed().as_secs_f64() * rate * size_of::<Pair>() as f64 + AHEAD;
        // All that is wanted, as some servers start to play once they have that.
        while stream.wanted >= size_of::<Pair>() && (stream.sent as f64) < fair {
            let samples = &mut samples[..(stream.wanted / size_of::<Pair>()).min(PIECE)];
            // Silence until it is known how late one is heard, and while time rests.
            let (Some(now), Some(delay), false) = (now, stream.delay(), rests) else {
                samples.fill([0; 2]);
                since = 0;
                if stream.send(samples).is_none() {
                    return;
                }
                continue;
            };
            // When this sample will be heard.
            let then = now + delay;
            if (then - next as f64 / rate).abs() > APART {
                next = (then * rate) as u64;
                since = 0;
            }
            score.samples(next, samples);
            next += samples.len() as u64;
            since += samples.len();
            if stream.send(samples).is_none() {
                return;
            }
        }
    }
}
