//! A drawing as PNG, on white.

use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint as SkiaPaint, PathBuilder, Pixmap, StrokeDash, Transform,
};

use super::drawing::{Anchor, Item, Paint, Point, Step, Stroke, Text};
use super::figure::Figure;
use super::font::Pen;

/// Points in an inch.
const POINTS_PER_INCH: f64 = 72.0;
/// Inches in a metre.
const INCHES_PER_METRE: f64 = 39.370_078_74;

/// Draws a figure as PNG at so many dots per inch.
///
/// # Errors
/// If the picture is too large to hold.
pub fn png(figure: &Figure, dpi: f64) -> anyhow::Result<Vec<u8>> {
    let Figure { title, drawing, .. } = figure;
    let scale = dpi / POINTS_PER_INCH;
    let pixels = |length: f64| (length * scale).ceil() as u32;
    let (width, height) = (pixels(drawing.width), pixels(drawing.height));
    let mut picture = Pixmap::new(width, height)
        .ok_or_else(|| anyhow::anyhow!("a picture of {width} x {height} pixels"))?;
    picture.fill(tiny_skia::Color::WHITE);
    let mut canvas = Canvas { picture, transform: Transform::from_scale(scale as f32, scale as f32) };
    for item in &drawing.items {
        canvas.item(item);
    }
    encode(&canvas.picture, [title, &figure.description()], dpi)
}

fn encode(picture: &Pixmap, [title, caption]: [&str; 2], dpi: f64) -> anyhow::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Fast);
    let per_metre = (dpi * INCHES_PER_METRE).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    encoder.add_itxt_chunk("Title".to_string(), title.to_string())?;
    encoder.add_itxt_chunk("Description".to_string(), caption.to_string())?;
    // All is opaque on white paper.
    let rgb: Vec<u8> =
        picture.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(bytes)
}

struct Canvas {
    picture: Pixmap,
    transform: Transform,
}

impl Canvas {
    fn item(&mut self, item: &Item) {
        match item {
            Item::Path { steps, fill, stroke } => {
                let mut path = PathBuilder::new();
                steps.iter().for_each(|step| add(&mut path, step));
                let Some(path) = path.finish() else { return };
                if let Some(fill) = fill {
                    self.fill(&path, *fill, self.transform);
                }
                if let Some(stroke) = stroke {
                    self.stroke(&path, stroke);
                }
            }
            Item::Dots { at, radius, paint } => {
                let mut path = PathBuilder::new();
                at.iter().for_each(|&[x, y]| path.push_circle(x as f32, y as f32, *radius as f32));
                if let Some(path) = path.finish() {
                    self.fill(&path, *paint, self.transform);
                }
            }
            Item::Text(text) => {
                let mut pen = PathPen(PathBuilder::new());
                outlines(text, &mut pen);
                let Some(path) = pen.0.finish() else { return };
                let [x, y] = text.at.map(|place| place as f32);
                let turned =
                    if text.upwards { Transform::from_rotate_at(-90.0, x, y) } else { Transform::identity() };
                self.fill(&path, text.ink.full(), self.transform.pre_concat(turned));
            }
        }
    }

    fn fill(&mut self, path: &tiny_skia::Path, paint: Paint, transform: Transform) {
        self.picture.fill_path(path, &colour(paint), FillRule::Winding, transform, None);
    }

    fn stroke(&mut self, path: &tiny_skia::Path, Stroke { paint, width, dash }: &Stroke) {
        let lengths = dash.lengths().iter().map(|&length| length as f32).collect();
        let stroke = tiny_skia::Stroke {
            width: *width as f32,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            dash: StrokeDash::new(lengths, 0.0),
            ..tiny_skia::Stroke::default()
        };
        self.picture.stroke_path(path, &colour(*paint), &stroke, self.transform, None);
    }
}

fn colour(Paint { ink, opacity }: Paint) -> SkiaPaint<'static> {
    let [r, g, b] = ink.on_white();
    let mut paint = SkiaPaint::default();
    paint.set_color_rgba8(r, g, b, (opacity * 255.0).round() as u8);
    paint.anti_alias = true;
    paint
}

fn add(path: &mut PathBuilder, step: &Step) {
    match *step {
        Step::Move([x, y]) => path.move_to(x as f32, y as f32),
        Step::Line([x, y]) => path.line_to(x as f32, y as f32),
        Step::Close => path.close(),
        Step::Circle([x, y], radius) => path.push_circle(x as f32, y as f32, radius as f32),
    }
}

/// Draws a text with a pen, not turned.
fn outlines(text: &Text, pen: &mut dyn Pen) {
    let width = text.label.width(text.size);
    let [mut x, y] = text.at;
    x -= match text.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * width,
        Anchor::End => width,
    };
    for run in &text.label.runs {
        let size = text.size * run.level.scale();
        run.face.outline(&run.words, size, [x, y + run.level.drop() * text.size], pen);
        x += run.face.width(&run.words, size);
    }
}

struct PathPen(PathBuilder);

impl Pen for PathPen {
    fn start(&mut self, [x, y]: Point) {
        self.0.move_to(x as f32, y as f32);
    }

    fn line(&mut self, [x, y]: Point) {
        self.0.line_to(x as f32, y as f32);
    }

    fn quadratic(&mut self, [a, b]: Point, [x, y]: Point) {
        self.0.quad_to(a as f32, b as f32, x as f32, y as f32);
    }

    fn cubic(&mut self, [[a, b], [c, d]]: [Point; 2], [x, y]: Point) {
        self.0.cubic_to(a as f32, b as f32, c as f32, d as f32, x as f32, y as f32);
    }

    fn close(&mut self) {
        self.0.close();
    }
}
