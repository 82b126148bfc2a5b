//! The moving picture of scenes: what its file holds.

#[path = "../examples/common_scene/animation.rs"]
mod animation;

use animation::{Animation, Rgb};
use gif::{ColorOutput, DecodeOptions, DisposalMethod, Repeat};

const WIDTH: usize = 12;
const HEIGHT: usize = 8;

/// Frames as a viewer shows them, one after another: colours, place and size of what was drawn, and how long they stay.
struct Shown {
    pixels: Vec<Rgb>,
    area: [u16; 4],
    delay: u16,
}

fn shown(file: &[u8]) -> Vec<Shown> {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options.read_info(file).expect("a GIF");
    assert_eq!((decoder.width(), decoder.height()), (WIDTH as u16, HEIGHT as u16));
    let mut screen = vec![[0; 3]; WIDTH * HEIGHT];
    let mut all = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        assert_eq!(frame.dispose, DisposalMethod::Keep);
        for (i, pixel) in frame.buffer.as_chunks::<4>().0.iter().enumerate() {
            let [x, y] = [i % usize::from(frame.width), i / usize::from(frame.width)];
            if pixel[3] != 0 {
                let at = (y + usize::from(frame.top)) * WIDTH + x + usize::from(frame.left);
                screen[at] = [pixel[0], pixel[1], pixel[2]];
            }
        }
        let area = [frame.left, frame.top, frame.width, frame.height];
        all.push(Shown { pixels: screen.clone(), area, delay: frame.delay });
    }
    assert_eq!(decoder.repeat(), Repeat::Infinite);
    all
}

fn encoded(frames: &[Vec<Rgb>]) -> Vec<u8> {
    let mut animation = Animation::new(WIDTH as u16, HEIGHT as u16);
    frames.iter().for_each(|frame| animation.push(frame.as_flattened()));
    animation.encode().expect("a file")
}

#[test]
fn few_colours_are_kept_and_only_changes_are_drawn() {
    let fresh = vec![[30, 60, 150]; WIDTH * HEIGHT];
    let mut rusty = fresh.clone();
    // Two pixels in opposite corners of a rectangle of 3 by 2.
    (rusty[2 * WIDTH + 4], rusty[3 * WIDTH + 6]) = ([140, 70, 20], [140, 70, 20]);
    let frames = [fresh, rusty.clone(), rusty];
    let shown = shown(&encoded(&frames));
    assert_eq!(shown.len(), frames.len());
    for (shown, frame) in shown.iter().zip(&frames) {
        assert_eq!(shown.pixels, *frame);
    }
    assert_eq!(shown[0].area, [0, 0, WIDTH as u16, HEIGHT as u16]);
    assert_eq!(shown[1].area, [4, 2, 3, 2]);
    assert_eq!(shown[2].area[2..], [1, 1], "nothing has changed");
    assert!(shown[2].delay > 10 * shown[1].delay, "the last frame stays");
}

#[test]
fn many_colours_are_mixed_and_trifles_passed_over() {
    let gradient = |shift: usize| -> Vec<Rgb> {
        (0..WIDTH * HEIGHT).map(|i| [i + shift, 2 * i + shift / 2, 200 - i].map(|c| c as u8)).collect()
    };
    let frames: Vec<Vec<Rgb>> = (0..12).map(|frame| gradient(frame * 10)).collect();
    let shown = shown(&encoded(&frames));
    assert_eq!(shown.len(), frames.len());
    let errors = shown.iter().zip(&frames).flat_map(|(shown, frame)| shown.pixels.iter().zip(frame)).map(|(a, b)| {
        let channels = a.iter().zip(b);
        channels.map(|(a, b)| u32::from(a.abs_diff(*b))).sum::<u32>()
    });
    let mean = f64::from(errors.sum::<u32>()) / (frames.len() * WIDTH * HEIGHT * 3) as f64;
    assert!(mean < 10.0, "colours are off by {mean} on average");

    let still = encoded(&[gradient(0), gradient(3), gradient(0)]);
    let once = encoded(&[gradient(0), gradient(0), gradient(0)]);
    assert_eq!(still.len(), once.len(), "a change that cannot be seen is not drawn");
}
