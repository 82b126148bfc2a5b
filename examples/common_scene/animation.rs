//! A moving picture: the frames of a fixed view become an animated GIF that loops.
//!
//! All frames share one palette. Colours between its colours are dithered in a pattern that stands still, and a pixel
//! is drawn only when its colour has changed visibly: so nothing crawls, and the file stays small.

use std::collections::{BTreeSet, HashMap};

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

/// An sRGB colour.
pub type Rgb = [u8; 3];

/// Hundredths of a second that a frame stays.
const DELAY: u16 = 12;
/// Hundredths of a second that the first frame and the last stay.
const PAUSES: [u16; 2] = [80, 250];
/// Colours of the palette; the index after them stands for pixels that stay as they are.
const COLORS: usize = 255;
const UNCHANGED: u8 = COLORS as u8;
/// Largest change of a channel that is passed over.
const TOLERANCE: u8 = 7;
/// Colours that one pixel's colour is mixed from.
const MIXED: usize = 8;
/// Share of the error that mixing makes up for: the rest is less grain, and a smaller file.
const STRENGTH: f32 = 0.6;
/// The order in which the mixed colours are spread over a block of pixels: neighbours are far apart in brightness.
const PATTERN: [[u8; 4]; 4] = [[0, 4, 1, 5], [6, 2, 7, 3], [1, 5, 0, 4], [7, 3, 6, 2]];

/// Frames of one size, in order.
pub struct Animation {
    width: u16,
    height: u16,
    frames: Vec<Vec<Rgb>>,
}

impl Animation {
    pub fn new(width: u16, height: u16) -> Self {
        Self { width, height, frames: Vec::new() }
    }

    /// Adds a frame: three bytes a pixel, row by row from the top. What is missing is black.
    pub fn push(&mut self, bytes: &[u8]) {
        let mut frame = bytes.as_chunks::<3>().0.to_vec();
        frame.resize(usize::from(self.width) * usize::from(self.height), [0; 3]);
        self.frames.push(frame);
    }

    /// Returns the GIF file.
    pub fn encode(&self) -> Result<Vec<u8>, EncodingError> {
        let mut palette = Palette::of(&self.sample());
        let mut encoder = Encoder::new(Vec::new(), self.width, self.height, &palette.bytes())?;
        encoder.set_repeat(Repeat::Infinite)?;
        let mut drawn = Vec::new();
        for (number, frame) in self.frames.iter().enumerate() {
            let delay = match number {
                n if n + 1 == self.frames.len() => PAUSES[1],
                0 => PAUSES[0],
                _ => DELAY,
            };
            let (left, top, width, height, buffer) = self.changed(frame, &mut drawn, &mut palette);
            encoder.write_frame(&Frame {
                delay,
                dispose: DisposalMethod::Keep,
                transparent: Some(UNCHANGED),
                left,
                top,
                width,
                height,
                buffer: buffer.into(),
                ..Frame::default()
            })?;
        }
        encoder.into_inner()
    }

    /// The colours that are drawn: the first frame, and what changes from frame to frame.
    fn sample(&self) -> Vec<Rgb> {
        let changes = self.frames.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1]));
        let changes = changes.filter(|(old, new)| differ(**old, **new)).map(|(_, new)| *new);
        self.frames.first().into_iter().flatten().copied().chain(changes).collect()
    }

    /// The smallest rectangle of `frame` that holds every pixel which no longer looks as it was `drawn`: left, top,
    /// width, height and pixels.
    fn changed(&self, frame: &[Rgb], drawn: &mut Vec<Rgb>, palette: &mut Palette) -> (u16, u16, u16, u16, Vec<u8>) {
        let whole = drawn.is_empty();
        if whole {
            drawn.resize(frame.len(), [0; 3]);
        }
        let width = usize::from(self.width);
        let mut pixels = vec![UNCHANGED; frame.len()];
        // A GIF has no empty frames: where nothing has changed, one pixel is left.
        let (mut low, mut high) = ([width - 1, usize::from(self.height) - 1], [0, 0]);
        for (i, (color, drawn)) in frame.iter().zip(drawn).enumerate() {
            if whole || differ(*color, *drawn) {
                let at = [i % width, i / width];
                pixels[i] = palette.index(*color, at);
                *drawn = *color;
                low = [low[0].min(at[0]), low[1].min(at[1])];
                high = [high[0].max(at[0]), high[1].max(at[1])];
            }
        }
        let high = [high[0].max(low[0]), high[1].max(low[1])];
        let rows = pixels.chunks_exact(width).skip(low[1]).take(high[1] + 1 - low[1]);
        let buffer = rows.flat_map(|row| &row[low[0]..=high[0]]).copied().collect();
        let [left, top, right, bottom] = [low[0], low[1], high[0], high[1]].map(|x| x as u16);
        (left, top, right + 1 - left, bottom + 1 - top, buffer)
    }
}

fn differ(a: Rgb, b: Rgb) -> bool {
    a.into_iter().zip(b).any(|(a, b)| a.abs_diff(b) > TOLERANCE)
}

/// The colours of the file.
struct Palette {
    colors: Vec<Rgb>,
    /// For colours met so far: the colours they are mixed from, the darkest first.
    mixed: HashMap<Rgb, [u8; MIXED]>,
}

impl Palette {
    /// The colours of the sample; where they are too many, those that stand for them best.
    fn of(sample: &[Rgb]) -> Self {
        let distinct: BTreeSet<Rgb> = sample.iter().copied().collect();
        let colors = if distinct.len() <= COLORS {
            distinct.into_iter().collect()
        } else {
            // Each counts as often as it occurs, and twice more: else small bright things would be drawn in greys.
            let counted = sample.iter().chain(&distinct).chain(&distinct);
            let opaque: Vec<u8> = counted.flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
            NeuQuant::new(3, COLORS, &opaque).color_map_rgb().as_chunks::<3>().0.to_vec()
        };
        Self { colors, mixed: HashMap::new() }
    }

    /// As the file has it.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.concat();
        bytes.resize((COLORS + 1) * 3, 0);
        bytes
    }

    /// The colour that a pixel is drawn in.
    fn index(&mut self, color: Rgb, [x, y]: [usize; 2]) -> u8 {
        let colors = &self.colors;
        self.mixed.entry(color).or_insert_with(|| mix(colors, color))[usize::from(PATTERN[y % 4][x % 4])]
    }
}

/// The colours that together come near to `wanted` (pattern dithering after Knoll): each is the nearest to what the
/// ones before it have left over.
fn mix(colors: &[Rgb], wanted: Rgb) -> [u8; MIXED] {
    let wanted = wanted.map(f32::from);
    let mut error = [0.0; 3];
    let mut mixed = [0; MIXED];
    for index in &mut mixed {
        let goal = [0, 1, 2].map(|k| wanted[k] + error[k] * STRENGTH);
        *index = nearest(colors, goal);
        let color = colors[usize::from(*index)].map(f32::from);
        error = [0, 1, 2].map(|k| error[k] + wanted[k] - color[k]);
    }
    let brightness = |index: &u8| {
        let [r, g, b] = colors[usize::from(*index)].map(u32::from);
        3 * r + 6 * g + b
    };
    mixed.sort_by_key(brightness);
    mixed
}

/// The colour that looks most like `wanted`: the eye tells greens apart best, and blues worst.
fn nearest(colors: &[Rgb], wanted: [f32; 3]) -> u8 {
    let distance = |color: &Rgb| {
        let [r, g, b] = [0, 1, 2].map(|k| f32::from(color[k]) - wanted[k]);
        3.0 * r * r + 6.0 * g * g + 2.0 * b * b
    };
    let best = colors.iter().enumerate().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
    best.map_or(0, |(index, _)| index as u8)
}
