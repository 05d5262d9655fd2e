//! Thrift's compact protocol, in which Parquet files describe themselves, read with trust in nothing: no length is believed
//! that the bytes at hand do not bear out, and nesting has an end.

/// How deep a description may nest.
const DEEPEST: usize = 24;

/// What the bytes are not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum Broken {
    /// They end too soon.
    #[error("the description ends too soon")]
    Ends,
    /// A length or kind is impossible.
    #[error("the description is damaged")]
    Damaged,
    /// It nests deeper than any real one.
    #[error("the description nests too deep")]
    Deep,
}

type Result<T> = std::result::Result<T, Broken>;

/// The kind of a value, as a number on the wire.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind(u8);

impl Kind {
    pub const TRUE: Kind = Kind(1);
    pub const FALSE: Kind = Kind(2);
    pub const I8: Kind = Kind(3);
    pub const I16: Kind = Kind(4);
    pub const I32: Kind = Kind(5);
    pub const I64: Kind = Kind(6);
    pub const DOUBLE: Kind = Kind(7);
    pub const BINARY: Kind = Kind(8);
    pub const LIST: Kind = Kind(9);
    pub const STRUCT: Kind = Kind(12);
}

/// Bytes, and how many of them have been read.
pub(super) struct Compact<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Compact<'a> {
    /// From the first of these bytes on.
    pub fn new(bytes: &'a [u8]) -> Compact<'a> {
        Compact { bytes, at: 0 }
    }

    /// How many bytes have been read.
    pub fn read(&self) -> usize {
        self.at
    }

    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn byte(&mut self) -> Result<u8> {
        let byte = *self.bytes.get(self.at).ok_or(Broken::Ends)?;
        self.at += 1;
        Ok(byte)
    }

    fn pass(&mut self, count: u64) -> Result<()> {
        let count = usize::try_from(count).ok().filter(|&count| count <= self.left()).ok_or(Broken::Ends)?;
        self.at += count;
        Ok(())
    }

    fn varint(&mut self) -> Result<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Ok(value);
            }
        }
        Err(Broken::Damaged)
    }

    /// A whole number.
    pub fn integer(&mut self) -> Result<i64> {
        let zigzag = self.varint()?;
        Ok((zigzag >> 1) as i64 ^ -((zigzag & 1) as i64))
    }

    /// Calls `visit` with the number and kind of each field of the struct that begins here; what it does not read is to be
    /// skipped by it.
    pub fn fields(&mut self, mut visit: impl FnMut(&mut Self, i64, Kind) -> Result<()>) -> Result<()> {
        let mut id = 0;
        loop {
            let byte = self.byte()?;
            if byte == 0 {
                return Ok(());
            }
            id = match byte >> 4 {
                0 => self.integer()?,
                step => id + i64::from(step),
            };
            if !(0..=i64::from(i16::MAX)).contains(&id) {
                return Err(Broken::Damaged);
            }
            visit(self, id, Kind(byte & 0x0f))?;
        }
    }

    /// The kind and number of the elements of the list that begins here: no more than there are bytes left.
    pub fn list(&mut self) -> Result<(Kind, usize)> {
        let byte = self.byte()?;
        let count = match byte >> 4 {
            15 => self.varint()?,
            count => u64::from(count),
        };
        let count = usize::try_from(count).ok().filter(|&count| count <= self.left()).ok_or(Broken::Ends)?;
        Ok((Kind(byte & 0x0f), count))
    }

    /// Passes over a field of a struct.
    pub fn skip(&mut self, kind: Kind) -> Result<()> {
        match kind {
            // The kind itself is the value.
            Kind::TRUE | Kind::FALSE => Ok(()),
            kind => self.skip_value(kind, DEEPEST),
        }
    }

    fn skip_value(&mut self, kind: Kind, deepest: usize) -> Result<()> {
        let deeper = deepest.checked_sub(1).ok_or(Broken::Deep)?;
        match kind.0 {
            1..=3 => self.pass(1),
            4..=6 => self.varint().map(drop),
            7 => self.pass(8),
            8 => {
                let length = self.varint()?;
                self.pass(length)
            }
            9 | 10 => {
                let (kind, count) = self.list()?;
                (0..count).try_for_each(|_| self.skip_value(kind, deeper))
            }
            12 => self.fields(|reader, _, kind| match kind {
                Kind::TRUE | Kind::FALSE => Ok(()),
                kind => reader.skip_value(kind, deeper),
            }),
            // Maps stand nowhere in Parquet.
            _ => Err(Broken::Damaged),
        }
    }
}
