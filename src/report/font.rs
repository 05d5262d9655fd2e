//! The fonts of all figures, shipped inside: no figure depends on those of a system.

use std::sync::LazyLock;

use ttf_parser::{GlyphId, OutlineBuilder};

/// Fira Sans in one style.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// Upright.
    Regular,
    /// Slanted, for variables.
    Italic,
    /// Heavy, for titles.
    SemiBold,
}

/// The files, cut down to Latin, Greek and mathematical signs.
const FILES: [&[u8]; 3] = [
    include_bytes!("assets/fonts/FiraSans-Regular.ttf"),
    include_bytes!("assets/fonts/FiraSans-Italic.ttf"),
    include_bytes!("assets/fonts/FiraSans-SemiBold.ttf"),
];

static FACES: LazyLock<[Option<ttf_parser::Face<'static>>; 3]> =
    LazyLock::new(|| FILES.map(|file| ttf_parser::Face::parse(file, 0).ok()));

/// Drawn in place of a letter that the font does not have.
const UNKNOWN: char = '?';

impl Face {
    pub const ALL: [Face; 3] = [Face::Regular, Face::Italic, Face::SemiBold];

    pub fn file(self) -> &'static [u8] {
        FILES[self as usize]
    }

    /// Measures words in a size, points.
    pub fn width(self, words: &str, size: f64) -> f64 {
        let Some(face) = &FACES[self as usize] else { return 0.0 };
        let scale = size / f64::from(face.units_per_em());
        words.chars().map(|letter| advance(face, letter) * scale).sum()
    }

    /// Draws words with the left end of their baseline at `at` into `pen`, which takes x and y downwards.
    pub fn outline(self, words: &str, size: f64, at: [f64; 2], pen: &mut dyn Pen) {
        let Some(face) = &FACES[self as usize] else { return };
        let scale = size / f64::from(face.units_per_em());
        let mut x = at[0];
        for letter in words.chars() {
            if let Some(glyph) = glyph(face, letter) {
                face.outline_glyph(glyph, &mut Placed { pen, scale, at: [x, at[1]] });
            }
            x += advance(face, letter) * scale;
        }
    }
}

fn glyph(face: &ttf_parser::Face, letter: char) -> Option<GlyphId> {
    face.glyph_index(letter).or_else(|| face.glyph_index(UNKNOWN))
}

fn advance(face: &ttf_parser::Face, letter: char) -> f64 {
    glyph(face, letter).and_then(|glyph| face.glyph_hor_advance(glyph)).map_or(0.0, f64::from)
}

/// Callbacks that draw outlines.
pub trait Pen {
    /// Begins a contour.
    fn start(&mut self, to: [f64; 2]);
    /// Draws a straight line.
    fn line(&mut self, to: [f64; 2]);
    /// Draws a quadratic curve.
    fn quadratic(&mut self, control: [f64; 2], to: [f64; 2]);
    /// Draws a cubic curve.
    fn cubic(&mut self, controls: [[f64; 2]; 2], to: [f64; 2]);
    /// Ends a contour.
    fn close(&mut self);
}

struct Placed<'a> {
    pen: &'a mut dyn Pen,
    scale: f64,
    at: [f64; 2],
}

impl Placed<'_> {
    fn place(&self, x: f32, y: f32) -> [f64; 2] {
        [self.at[0] + f64::from(x) * self.scale, self.at[1] - f64::from(y) * self.scale]
    }
}

impl OutlineBuilder for Placed<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.pen.start(self.place(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.pen.line(self.place(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.pen.quadratic(self.place(x1, y1), self.place(x, y));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.pen.cubic([self.place(x1, y1), self.place(x2, y2)], self.place(x, y));
    }

    fn close(&mut self) {
        self.pen.close();
    }
}
