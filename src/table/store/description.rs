//! The structs in which a Parquet file describes itself: of what kind each field is. Its decoder reads the fields that it knows
//! as what they should be, whatever the file says they are, so that one which says otherwise is read in two ways.

use super::compact::{Broken, Compact, Kind};

/// What a field is.
#[derive(Clone, Copy)]
pub(super) enum Field {
    Bool,
    I8,
    I16,
    I32,
    I64,
    Double,
    Binary,
    List(&'static Field),
    Struct(&'static Struct),
}

/// The known fields of a struct by their number.
pub(super) struct Struct(&'static [(i64, Field)]);

use Field::{Binary, Bool, Double, I8, I16, I32, I64, List};

const EMPTY: Field = Field::Struct(&Struct(&[]));

const STATISTICS: Field = Field::Struct(&Struct(&[
    (1, Binary),
    (2, Binary),
    (3, I64),
    (4, I64),
    (5, Binary),
    (6, Binary),
    (7, Bool),
    (8, Bool),
]));

const KEY_VALUES: Field = List(&Field::Struct(&Struct(&[(1, Binary), (2, Binary)])));

const TIME_UNIT: Field = Field::Struct(&Struct(&[(1, EMPTY), (2, EMPTY), (3, EMPTY)]));
const TIME: Field = Field::Struct(&Struct(&[(1, Bool), (2, TIME_UNIT)]));

const LOGICAL_TYPE: Field = Field::Struct(&Struct(&[
    (1, EMPTY),
    (2, EMPTY),
    (3, EMPTY),
    (4, EMPTY),
    (5, Field::Struct(&Struct(&[(1, I32), (2, I32)]))),
    (6, EMPTY),
    (7, TIME),
    (8, TIME),
    (10, Field::Struct(&Struct(&[(1, I8), (2, Bool)]))),
    (11, EMPTY),
    (12, EMPTY),
    (13, EMPTY),
    (14, EMPTY),
    (15, EMPTY),
    (16, Field::Struct(&Struct(&[(1, I8)]))),
    (17, Field::Struct(&Struct(&[(1, Binary)]))),
    (18, Field::Struct(&Struct(&[(1, Binary), (2, I32)]))),
]));

const SCHEMA_ELEMENT: Field = Field::Struct(&Struct(&[
    (1, I32),
    (2, I32),
    (3, I32),
    (4, Binary),
    (5, I32),
    (6, I32),
    (7, I32),
    (8, I32),
    (9, I32),
    (10, LOGICAL_TYPE),
]));

const BOUNDING_BOX: Field = Field::Struct(&Struct(&[
    (1, Double),
    (2, Double),
    (3, Double),
    (4, Double),
    (5, Double),
    (6, Double),
    (7, Double),
    (8, Double),
]));

const COLUMN_METADATA: Field = Field::Struct(&Struct(&[
    (1, I32),
    (2, List(&I32)),
    (3, List(&Binary)),
    (4, I32),
    (5, I64),
    (6, I64),
    (7, I64),
    (8, KEY_VALUES),
    (9, I64),
    (10, I64),
    (11, I64),
    (12, STATISTICS),
    (13, List(&Field::Struct(&Struct(&[(1, I32), (2, I32), (3, I32)])))),
    (14, I64),
    (15, I32),
    (16, Field::Struct(&Struct(&[(1, I64), (2, List(&I64)), (3, List(&I64))]))),
    (17, Field::Struct(&Struct(&[(1, BOUNDING_BOX), (2, List(&I32))]))),
]));

const COLUMN_CHUNK: Field = Field::Struct(&Struct(&[
    (1, Binary),
    (2, I64),
    (3, COLUMN_METADATA),
    (4, I64),
    (5, I32),
    (6, I64),
    (7, I32),
]));

const ROW_GROUP: Field = Field::Struct(&Struct(&[
    (1, List(&COLUMN_CHUNK)),
    (2, I64),
    (3, I64),
    (4, List(&Field::Struct(&Struct(&[(1, I32), (2, Bool), (3, Bool)])))),
    (5, I64),
    (6, I64),
    (7, I16),
]));

/// The footer.
pub(super) const FILE: Struct = Struct(&[
    (1, I32),
    (2, List(&SCHEMA_ELEMENT)),
    (3, I64),
    (4, List(&ROW_GROUP)),
    (5, KEY_VALUES),
    (6, Binary),
    (7, List(&Field::Struct(&Struct(&[(1, EMPTY), (2, EMPTY)])))),
]);

/// What stands before a page.
pub(super) const PAGE_HEADER: Struct = Struct(&[
    (1, I32),
    (2, I32),
    (3, I32),
    (4, I32),
    (5, Field::Struct(&Struct(&[(1, I32), (2, I32), (3, I32), (4, I32), (5, STATISTICS)]))),
    (6, EMPTY),
    (7, Field::Struct(&Struct(&[(1, I32), (2, I32), (3, Bool)]))),
    (
        8,
        Field::Struct(&Struct(&[
            (1, I32),
            (2, I32),
            (3, I32),
            (4, I32),
            (5, I32),
            (6, I32),
            (7, Bool),
            (8, STATISTICS),
        ])),
    ),
]);

impl Struct {
    /// Passes over a struct of which each known field is what it should be; others are what they say.
    ///
    /// # Errors
    /// If one is not, or the bytes are no struct.
    pub fn pass(&self, reader: &mut Compact) -> Result<(), Broken> {
        reader.fields(|reader, id, kind| match self.0.iter().find(|(known, _)| *known == id) {
            Some((_, field)) if field.is(kind) => field.pass(reader, kind),
            Some(_) => Err(Broken::Damaged),
            None => reader.skip(kind),
        })
    }
}

impl Field {
    fn is(&self, kind: Kind) -> bool {
        match self {
            Bool => kind == Kind::TRUE || kind == Kind::FALSE,
            I8 => kind == Kind::I8,
            I16 => kind == Kind::I16,
            I32 => kind == Kind::I32,
            I64 => kind == Kind::I64,
            Double => kind == Kind::DOUBLE,
            Binary => kind == Kind::BINARY,
            List(_) => kind == Kind::LIST,
            Field::Struct(_) => kind == Kind::STRUCT,
        }
    }

    fn pass(&self, reader: &mut Compact, kind: Kind) -> Result<(), Broken> {
        match self {
            Field::Struct(known) => known.pass(reader),
            List(element) => {
                let (kind, count) = reader.list()?;
                if count > 0 && !element.is(kind) {
                    return Err(Broken::Damaged);
                }
                (0..count).try_for_each(|_| element.pass(reader, kind))
            }
            // No list of truths is known, whose elements would have a byte each.
            _ => reader.skip(kind),
        }
    }
}
