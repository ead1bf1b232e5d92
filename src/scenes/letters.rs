//! A font of strokes.

use glam::Vec3;

/// A to Z, a line each: points to be joined, and blanks where the pen is lifted. Points are letters, from a to c at the
/// foot, then upwards, three in a row, to o.
const GLYPHS: &str = "\
agnic gi
amnlhg hfba
onjdbc
amnlfba
camo gh
amo gh
onjdbcih
am co gi
bn
ofbd
am ogc
mac
amhoc
amco
bdjnlfb
amnlhg
bdjnlfb ec
amnlhg hc
onjfba
mo nb
mdbfo
mbo
mahco
ao mc
mho hb
moac";

/// The strokes of a text of capitals and blanks: the foot of its middle at `middle`, letters along `right` and `up`, whose
/// lengths are half a letter's width and a quarter of its height.
pub fn write(text: &str, middle: Vec3, right: Vec3, up: Vec3) -> Vec<[Vec3; 2]> {
    let mut lines = Vec::new();
    for (place, letter) in text.bytes().enumerate() {
        let number = letter.wrapping_sub(b'A') as usize;
        let corner = middle + right * (3.0 * place as u32 as f32 - 1.5 * text.len() as u32 as f32 + 0.5);
        let mut last = None;
        // Lines are counted here: to split them takes a searcher of 500 bytes.
        let mut line = 0;
        for point in GLYPHS.bytes() {
            if point == b'\n' {
                line += 1;
            }
            let next = (point >= b'a').then(|| {
                let k = (point - b'a') as u32;
                corner + right * (k % 3) as f32 + up * (k / 3) as f32
            });
            if let (Some(from), Some(to)) = (last, next)
                && line == number
            {
                lines.push([from, to]);
            }
            last = next;
        }
    }
    lines
}
