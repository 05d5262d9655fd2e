//! How the files of people are to be read.

use clap::Args;
use serde::{Deserialize, Serialize};

use crate::inputs::objects::ListDefaults;
use crate::inputs::{Building, Reader, Rename};
use crate::pipeline::options::number;

#[derive(Debug, Clone, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct ListArgs {
    /// Column names for headings of lists, hazards and tables of motions
    #[arg(long, value_name = "COLUMN=HEADING,...", value_delimiter = ',')]
    columns: Vec<Rename>,
    /// Headings of columns of these files to leave out
    #[arg(long, value_name = "HEADING,...", value_delimiter = ',')]
    ignore: Vec<String>,
    /// Number that the floors of a list give the ground floor: 0 or 1
    #[arg(long, value_name = "N", value_parser = number(0..=1_u32, "0 or 1"))]
    ground_floor: Option<u32>,
    /// Storeys of the building, for rows of a list that do not say theirs
    #[arg(long, value_name = "N", value_parser = number(1..=199_u32, "1 to 199 storeys"))]
    storeys: Option<u32>,
    /// Its kind: walls, masonry, concrete frame or steel frame
    #[arg(long, value_name = "KIND", value_parser = kind_of_building)]
    building: Option<String>,
}

impl ListArgs {
    pub fn reader(&self) -> Reader<'_> {
        Reader::new(&self.columns, &self.ignore)
    }

    /// What holds for all rows of a list.
    pub fn defaults(&self) -> ListDefaults {
        let building = self.building.as_deref().and_then(Building::parse);
        let ListArgs { ground_floor, storeys, .. } = *self;
        ListDefaults { ground_floor, storeys, building, ..ListDefaults::default() }
    }
}

fn kind_of_building(text: &str) -> Result<String, &'static str> {
    let expected = "expected walls, masonry, concrete frame or steel frame";
    Building::parse(text).map(|_| text.to_string()).ok_or(expected)
}
