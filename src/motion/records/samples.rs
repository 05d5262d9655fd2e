use super::error::RecordFileError;
use super::numbers::Numbers;
use super::text::Line;

/// How a Fortran program laid out numbers: so many on a line, each so many characters wide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Numbers on a line.
    pub on_line: usize,
    /// Characters of each.
    pub width: usize,
}

impl Layout {
    /// From a Fortran format such as `(8F10.5)`, `(10I8)` or `(1E15.6)`, the last one in a text.
    pub fn in_text(text: &str) -> Option<Layout> {
        let inside = text.get(text.rfind('(')? + 1..)?.split(')').next()?;
        let letter = inside.find(|c: char| matches!(c.to_ascii_uppercase(), 'F' | 'E' | 'D' | 'G' | 'I'))?;
        let (count, width) = inside.split_at(letter);
        let width = width.get(1..)?.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()?;
        let on_line = if count.trim().is_empty() { 1 } else { count.trim().parse().ok()? };
        (on_line > 0 && width > 0).then_some(Layout { on_line, width })
    }

    /// The lines that `count` numbers take.
    pub fn lines(&self, count: u64) -> u64 {
        count.div_ceil(self.on_line as u64)
    }
}

/// Numbers in order, and how many of them stand on the last line.
#[derive(Default)]
struct Block {
    values: Vec<f64>,
    on_last_line: usize,
}

/// The announced number of samples from these lines: by the width of numbers where the file says it, since they may stand
/// without a gap; but files whose blanks were changed later do not keep to it, and are read as numbers that anything
/// parts. Surplus numbers that only fill the last line are padding.
///
/// # Errors
/// If something is no number, or the count is wrong.
pub fn samples<'a>(
    lines: impl Iterator<Item = Line<'a>> + Clone,
    announced: u64,
    layout: Option<Layout>,
) -> Result<Vec<f64>, RecordFileError> {
    let by_width = layout.map(|layout| read(lines.clone(), |text| fields(text, layout.width)));
    let block = match by_width {
        Some(Ok(block)) if fits(&block, announced) => block,
        _ => read(lines, Numbers::of)?,
    };
    let found = block.values.len();
    if !fits(&block, announced) {
        return Err(RecordFileError::Count { announced, found });
    }
    let mut values = block.values;
    values.truncate(usize::try_from(announced).unwrap_or(found));
    if values.len() < 2 { Err(RecordFileError::TooShort { found: values.len() }) } else { Ok(values) }
}

fn fits(block: &Block, announced: u64) -> bool {
    let found = block.values.len() as u64;
    found >= announced && found - announced < block.on_last_line.max(1) as u64
}

/// Numbers by their places: fields of one width, of which the last may be shorter.
fn fields(text: &str, width: usize) -> impl Iterator<Item = Result<f64, &str>> {
    let text = text.trim_end();
    let field = move |k: usize| text.get(k * width..((k + 1) * width).min(text.len())).unwrap_or(text);
    (0..text.len().div_ceil(width)).map(field).map(|field| {
        let mut numbers = Numbers::of(field);
        match (numbers.next(), numbers.next()) {
            (Some(Ok(value)), None) => Ok(value),
            _ => Err(field),
        }
    })
}

fn read<'a, N: Iterator<Item = Result<f64, &'a str>>>(
    lines: impl Iterator<Item = Line<'a>>,
    numbers: impl Fn(&'a str) -> N,
) -> Result<Block, RecordFileError> {
    let mut block = Block::default();
    for line in lines {
        let before = block.values.len();
        for number in numbers(line.text) {
            let no_number =
                |text| RecordFileError::NoNumber { line: line.number, text: super::text::quoted(text) };
            block.values.push(number.map_err(no_number)?);
        }
        if block.values.len() > before {
            block.on_last_line = block.values.len() - before;
        }
    }
    Ok(block)
}
