//! A table is a struct: its fields name the columns, their order is that of the file, and an `Option` may be null.

use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::{ArrowError, DataType, Schema, SchemaRef};

use super::TableError;
use super::schema::{self, Table};
use super::store::columns::Columns;
use super::store::provenance::Provenance;
use super::store::reader::Batches;
use super::store::source::{Source, Target};
use super::store::writer::TableWriter;

/// The row of a table.
pub trait Row: Sized {
    const TABLE: Table;
}

/// A row that is written.
pub trait WriteRow: Row {
    /// The columns in order; `by_name` says whether motions go by name rather than by number.
    fn arrays<'r>(rows: impl Iterator<Item = &'r Self> + Clone, by_name: bool) -> Vec<ArrayRef>
    where
        Self: 'r;

    /// Makes a batch in the table's own schema.
    ///
    /// # Errors
    /// If memory runs out.
    fn batch(rows: &[Self]) -> Result<RecordBatch, ArrowError> {
        RecordBatch::try_new(Self::TABLE.schema(), Self::arrays(rows.iter(), false))
    }

    /// Makes a batch in a schema that may differ from the table's own in the type of `motion_id`.
    ///
    /// # Errors
    /// If a motion without a number stands in a column of numbers.
    fn batch_in(rows: &[Self], schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
        RecordBatch::try_new(schema.clone(), Self::arrays(rows.iter(), ids_are_names(schema)))
    }

    /// Writes a whole file.
    ///
    /// # Errors
    /// If it cannot be written, or an input is no longer what it was.
    fn write(rows: &[Self], target: impl Into<Target>, provenance: &Provenance) -> anyhow::Result<()> {
        let mut writer = TableWriter::create(target, &Self::TABLE, provenance.clone())?;
        writer.append(&Self::batch(rows)?)?;
        Ok(writer.finish()?)
    }
}

/// A row that is read. One with fewer columns than the file reads these alone.
pub trait ReadRow: Row {
    /// Reads the rows of a batch.
    ///
    /// # Errors
    /// If a column is missing or of another type, or a value cannot be used.
    fn of(columns: &Columns) -> Result<Vec<Self>, TableError>;

    /// Reads a whole table.
    ///
    /// # Errors
    /// If it is missing, unreadable, empty or the output of another stage, or as [`ReadRow::of`].
    fn read(source: impl Into<Source>) -> Result<Vec<Self>, TableError> {
        let batches = Batches::open_whole(source, &Self::TABLE, &[Self::TABLE.stage])?;
        let rows: Vec<Vec<Self>> =
            batches.map(|batch| Self::of(&batch?.columns())).collect::<Result<_, TableError>>()?;
        Ok(rows.into_iter().flatten().collect())
    }
}

/// The schema of a table in which motions go by name or by number.
pub fn schema_of(table: &Table, by_name: bool) -> SchemaRef {
    let own = table.schema();
    if !by_name {
        return own;
    }
    let fields = own.fields().iter().map(|field| match field.name() == schema::motion_id.name {
        true => field.as_ref().clone().with_data_type(schema::motion_name.kind.data_type()),
        false => field.as_ref().clone(),
    });
    Arc::new(Schema::new(fields.collect::<Vec<_>>()))
}

/// Whether motions go by name rather than by number.
pub fn ids_are_names(schema: &Schema) -> bool {
    let field = schema.field_with_name(schema::motion_id.name);
    field.is_ok_and(|field| match field.data_type() {
        DataType::Dictionary(_, of) => !of.is_numeric(),
        other => !other.is_numeric(),
    })
}

/// Declares a table as the struct of its rows: `pub struct Row as TABLE = "name" by "stage" { field: Type, ... }`. A field has
/// the name of its column; where the dictionary has several columns of that name, `field: Type = column` says which. Rows
/// that borrow are written only, others are read as well.
///
/// `pub struct Row of TABLE { ... }` is a row of some columns of a table, or of one table or another, to be read.
macro_rules! table {
    (
        $(#[$meta:meta])*
        pub struct $row:ident<$life:lifetime> as $table:ident = $name:literal by $stage:literal { $($fields:tt)* }
    ) => {
        $crate::table::row::table!(@table [$(#[$meta])*] $row [$life] $table $name $stage { $($fields)* });
    };
    (
        $(#[$meta:meta])*
        pub struct $row:ident as $table:ident = $name:literal by $stage:literal { $($fields:tt)* }
    ) => {
        $crate::table::row::table!(@table [$(#[$meta])*] $row [] $table $name $stage { $($fields)* });
        $crate::table::row::table!(@read $row { $($fields)* });
    };
    (
        $(#[$meta:meta])*
        pub struct $row:ident of $table:ident $(or $other:ident)* { $($fields:tt)* }
    ) => {
        $crate::table::row::table!(@struct [$(#[$meta])*] $row [] ($table.name) ($table.stage) { $($fields)* });
        $crate::table::row::table!(@read $row { $($fields)* });
        const _: () = assert!($crate::table::schema::Table::have_all(
            &[$table $(, $other)*],
            <$row as $crate::table::row::Row>::TABLE.columns
        ));
    };
    (
        @table [$(#[$meta:meta])*] $row:ident [$($life:lifetime)?] $table:ident $name:literal $stage:literal
        { $($(#[$about:meta])* $field:ident: $type:ty $(= $column:ident)?,)* }
    ) => {
        $crate::table::row::table!(
            @struct [$(#[$meta])*] $row [$($life)?] ($name) ($stage)
            { $($(#[$about])* $field: $type $(= $column)?,)* }
        );

        $(#[$meta])*
        pub const $table: $crate::table::schema::Table = <$row as $crate::table::row::Row>::TABLE;

        impl$(<$life>)? $crate::table::row::WriteRow for $row$(<$life>)? {
            fn arrays<'r>(
                rows: impl Iterator<Item = &'r Self> + Clone,
                by_name: bool,
            ) -> Vec<arrow_array::ArrayRef>
            where
                Self: 'r,
            {
                use $crate::table::cell::WriteCell;
                vec![$(<$type as WriteCell>::array(rows.clone().map(|row| &row.$field), by_name)),*]
            }
        }
    };
    (
        @struct [$(#[$meta:meta])*] $row:ident [$($life:lifetime)?] ($name:expr) ($stage:expr)
        { $($(#[$about:meta])* $field:ident: $type:ty $(= $column:ident)?,)* }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $row$(<$life>)? {
            $($(#[$about])* pub $field: $type,)*
        }

        impl$(<$life>)? $crate::table::row::Row for $row$(<$life>)? {
            const TABLE: $crate::table::schema::Table = $crate::table::schema::Table {
                name: $name,
                stage: $stage,
                columns: &[$($crate::table::row::table!(@column $field, $type $(, $column)?)),*],
            };
        }
    };
    (@read $row:ident { $($(#[$about:meta])* $field:ident: $type:ty $(= $column:ident)?,)* }) => {
        impl $crate::table::row::ReadRow for $row {
            fn of(columns: &$crate::table::store::columns::Columns) -> Result<Vec<Self>, $crate::table::TableError> {
                use $crate::table::cell::ReadCell;
                $(
                    let mut $field = <$type as ReadCell>::read(
                        columns,
                        const { &$crate::table::row::table!(@column $field, $type $(, $column)?) },
                    )?
                    .into_iter();
                )*
                Ok(std::iter::from_fn(|| Some(Self { $($field: $field.next()?),* })).collect())
            }
        }
    };
    (@column $field:ident, $type:ty) => {
        $crate::table::row::table!(@column $field, $type, $field)
    };
    (@column $field:ident, $type:ty, $column:ident) => {
        $crate::table::cell::column_of::<$type>($crate::table::schema::$column, stringify!($field))
    };
}

pub(crate) use table;
