//! Tables as a workbook of Office Open XML, in which each cell says whether it is a text or a number.

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, FormatAlign, Workbook, Worksheet};

use super::{Table, Value};

/// Widths of columns, in digits.
const NARROWEST: usize = 8;
const WIDEST: usize = 60;

/// The workbook; `None` if a sheet has no room for a row or a text.
pub(super) fn write(tables: &[Table]) -> Option<Vec<u8>> {
    let text = Format::new().set_num_format("@").set_align(FormatAlign::Top).set_text_wrap();
    let number = Format::new().set_align(FormatAlign::Top);
    let title = Format::new().set_num_format("@").set_bold();
    let mut workbook = Workbook::new();
    // Without a date of its own, a workbook has that of the clock.
    let created = ExcelDateTime::from_ymd(2000, 1, 1).ok()?;
    workbook.set_properties(&DocProperties::new().set_creation_datetime(&created));
    for table in tables {
        let mut sheet = Worksheet::new();
        sheet.set_name(table.name).ok()?;
        sheet.set_freeze_panes(1, 0).ok()?;
        for (column, name) in (0..).zip(&table.titles) {
            let texts = table.rows.iter().filter_map(|row| row.get(usize::from(column)));
            let longest =
                texts.map(|value| value.text().lines().map(|line| line.chars().count()).max().unwrap_or(0));
            let width = longest.max().unwrap_or(0).max(name.chars().count()) + 2;
            let width = u32::try_from(width.clamp(NARROWEST, WIDEST)).ok()?;
            sheet.set_column_width(column, width).ok()?;
            sheet.write_string_with_format(0, column, name, &title).ok()?;
        }
        for (row, values) in (1..).zip(&table.rows) {
            for (column, value) in (0..).zip(values).filter(|(_, value)| !value.is_empty()) {
                match value {
                    Value::Number(value) => sheet.write_with_format(row, column, *value, &number).ok()?,
                    Value::Text(value) => sheet.write_string_with_format(row, column, value, &text).ok()?,
                };
            }
        }
        let last_row = u32::try_from(table.rows.len()).ok()?;
        let last_column = u16::try_from(table.titles.len()).ok()?.checked_sub(1)?;
        sheet.autofilter(0, 0, last_row, last_column).ok()?;
        workbook.push_worksheet(sheet);
    }
    workbook.save_to_buffer().ok()
}
