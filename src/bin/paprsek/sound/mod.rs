//! The sound of the show: played while the show plays, or saved beside a capture.
//!
//! The sound leads. What a sound card plays in a second is not quite a second by the processor's clock, and a gap or a
//! jump is heard sooner than a frame that comes a little late. So the clock of the picture follows what is heard, and
//! where one pauses or seeks the sound goes to where the clock is.

#[cfg(target_os = "linux")]
mod pulse;
#[cfg(feature = "full")]
mod wav;

#[cfg(feature = "full")]
pub use wav::save;

#[cfg(target_os = "linux")]
use paprsek::scenes::show::score::score;
#[cfg(target_os = "linux")]
use paprsek::sound::{BLOCK, RATE};
#[cfg(target_os = "linux")]
use pulse::{PIECE, SECOND, Stream};
#[cfg(target_os = "linux")]
use std::time::Instant;

/// How far the sound may be from the clock before it jumps, seconds: less is made up for by the clock.
#[cfg(target_os = "linux")]
const APART: f64 = 0.06;
/// How far ahead of time a server may get, seconds: one that asks for more does not play.
#[cfg(target_os = "linux")]
const AHEAD: f64 = 6.0;
/// Seconds of a block.
#[cfg(target_os = "linux")]
const EACH: f64 = BLOCK as f64 / RATE as f64;
/// A block that is never due.
#[cfg(target_os = "linux")]
const NONE: u32 = u32::MAX;

/// Plays the show until the server goes. Without one it returns at once: the show plays on in silence, and nobody is
/// told.
///
/// `clock` is told the time of the show that is heard, if that is known, and says what time it is; none while time rests
/// and past the end.
#[cfg(target_os = "linux")]
pub fn play(clock: &dyn Fn(Option<f64>) -> Option<f64>) -> Option<()> {
    let mut stream = Stream::open()?;
    let mut score = score();
    // Times are seconds since now.
    let began = Instant::now();
    // The next block of the show; when it will be heard; and from when on what is heard is the show since it jumped.
    let (mut next, mut heard, mut since) = (NONE, f64::NAN, f64::INFINITY);
    loop {
        let delay = stream.listen()?;
        let now = began.elapsed().as_secs_f64();
        let mut known = None;
        if let Some(delay) = delay {
            heard = now + delay;
            if now > since {
                known = Some(f64::from(next) * EACH - delay);
            }
        }
        let time = clock(known);
        let asks = stream.wanted > 0;
        while stream.wanted > 0 && stream.sent as f64 / SECOND - now < AHEAD {
            let mut piece = [[[0; 2]; BLOCK]; PIECE];
            // Silence until it is known how late one is heard, and while time rests.
            if let Some(time) = time
                && !heard.is_nan()
            {
                // The time of the show when this piece will be heard.
                let then = (time + (heard - now)).max(0.0);
                if (then - f64::from(next) * EACH).abs() > APART {
                    next = (then / EACH) as u32;
                    since = heard;
                }
                for block in &mut piece {
                    *block = score.block(next);
                    // A server that tells wild times gets the last block there can be, which is silent.
                    next = next.saturating_add(1);
                }
            } else {
                (next, since) = (NONE, f64::INFINITY);
            }
            heard += PIECE as f64 * EACH;
            stream.send(piece.as_flattened())?;
        }
        if asks {
            stream.ask()?;
        }
    }
}
