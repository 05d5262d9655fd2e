use std::fmt::Write;

use crate::report::label::escape;
use crate::report::material::Table;
use crate::report::number;

/// The section of all tables.
pub fn section(html: &mut String, tables: &[Table]) {
    if tables.is_empty() {
        return;
    }
    html.push_str("<section id=\"tables\"><h2>Tables</h2>\n");
    for table in tables {
        write_table(html, table);
    }
    html.push_str("</section>\n");
}

fn write_table(html: &mut String, Table { title, columns, rows, left_out }: &Table) {
    let title = escape(title);
    let _ = write!(
        html,
        "<h3>{title}</h3>\n<div class=\"table\" tabindex=\"0\" role=\"group\" aria-label=\"{title}\"><table><thead><tr>"
    );
    let class = |numeric: bool| if numeric { " class=\"number\"" } else { "" };
    for column in columns {
        let (name, description) = (escape(&column.name), escape(&column.description));
        let _ =
            write!(html, "<th scope=\"col\" title=\"{description}\"{}>{name}</th>", class(column.numeric));
    }
    html.push_str("</tr></thead><tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for (cell, column) in row.iter().zip(columns) {
            let _ = write!(html, "<td{}>{}</td>", class(column.numeric), escape(cell));
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table></div>\n");
    if *left_out > 0 {
        let _ = writeln!(html, "<p>{} further rows are in the file.</p>", number::count(*left_out));
    }
}
