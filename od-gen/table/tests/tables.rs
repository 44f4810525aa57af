//! Tables of different makers' styles: what is understood of them, and what is asked.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use od_spec::source::SourceMap;
use od_table::{Assigned, Notation, assigned, import};
use rust_xlsxwriter::{Format, Workbook};

/// The messages with their places, and the specification.
fn made(name: &str, bytes: Vec<u8>, columns: Option<&Assigned>) -> String {
    let notation = Notation::of_extension(Path::new(name).extension().unwrap().to_str().unwrap()).unwrap();
    let mut sources = SourceMap::new();
    let (diagnostics, text) = match import(&mut sources, name, bytes, notation, columns, "device") {
        Ok(made) => (made.diagnostics, made.specification.text),
        Err(diagnostics) => (diagnostics, "nothing\n".to_owned()),
    };
    let mut result = String::new();
    for one in &diagnostics {
        let place = one.labels.first().map(|label| sources.place(label.span)).unwrap_or_default();
        let _ = writeln!(result, "{place}: {}: {}", one.code.id, one.message);
        for note in one.all_notes() {
            let _ = writeln!(result, "    {note}");
        }
    }
    result + "\n" + &text
}

#[test]
fn tables_of_different_styles_are_understood() {
    insta::glob!("tables/*", |path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        insta::assert_snapshot!(made(name, fs::read(path).unwrap(), None));
    });
}

/// A workbook with merged cells, numbers, a date and two sheets.
fn workbook() -> Vec<u8> {
    let mut book = Workbook::new();
    let format = Format::new();
    let sheet = book.add_worksheet().set_name("Parameter").unwrap();
    for (column, title) in (0..).zip(["Index", "Sub", "Name", "Data type", "Access", "Default", "Unit"]) {
        sheet.write_string(2, column, title).unwrap();
    }
    sheet.merge_range(3, 0, 5, 0, "2000h", &format).unwrap();
    sheet.merge_range(3, 4, 5, 4, "rw", &format).unwrap();
    for (row, sub, name, default) in [(3, 1, "first", 10.0), (4, 2, "second", 0.5), (5, 3, "third", -7.0)] {
        sheet.write_number(row, 1, f64::from(sub)).unwrap();
        sheet.write_string(row, 2, name).unwrap();
        sheet.write_string(row, 3, "INT16").unwrap();
        sheet.write_number(row, 5, default).unwrap();
    }
    // In Excel, `1E00` is a number and `1.10` a date.
    sheet.write_number(6, 0, 1.0).unwrap();
    sheet.write_string(6, 2, "lost").unwrap();
    let date = rust_xlsxwriter::ExcelDateTime::from_ymd(2026, 1, 10).unwrap();
    sheet.write_number(7, 0, 2001.0).unwrap();
    sheet.write_string(7, 2, "ratio").unwrap();
    sheet.write_string(7, 3, "REAL32").unwrap();
    sheet.write_string(7, 4, "ro").unwrap();
    sheet.write_datetime_with_format(7, 5, date, &Format::new().set_num_format("d.m.yyyy")).unwrap();
    let sheet = book.add_worksheet().set_name("Status").unwrap();
    let rows = [
        &["Index", "Name", "Type", "Access"][..],
        &["2010h", "status", "BYTE", "ro"],
        &["Bit", "Name"],
        &["0", "ready"],
        &["7:1", "reserved"],
    ];
    for (row, cells) in (0..).zip(rows) {
        for (column, cell) in (0..).zip(cells) {
            sheet.write_string(row, column, *cell).unwrap();
        }
    }
    book.save_to_buffer().unwrap()
}

#[test]
fn a_workbook_is_read_with_its_merged_cells() {
    insta::assert_snapshot!(made("motor.xlsx", workbook(), None));
}

#[test]
fn columns_can_be_assigned() {
    let columns = assigned("Index=A, Name=C, Type=D, Access=5").unwrap();
    let text = "2000h;x;level;U8;rw\nremark;;;;\n2001h;;limit;U8;ro\n";
    insta::assert_snapshot!(made("own.csv", text.into(), Some(&columns)));
}

#[test]
fn what_is_no_table_is_refused() {
    insta::assert_snapshot!(
        ["2000h;level;U8;rw\n", "", "colour;size\nred;5\n"]
            .map(|text| made("a.csv", text.into(), None))
            .concat()
            + &made("a.xlsx", b"PK".to_vec(), None)
            + &made("a.ods", b"PK".to_vec(), None)
    );
}

/// Tables that are cut, doubled and changed at random bytes are imported or refused.
#[test]
fn no_mutant_of_a_table_panics() {
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        usize::try_from(state >> 33).unwrap() % below.max(1)
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tables");
    let mut seeds: Vec<(String, Vec<u8>)> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap()))
        .collect();
    seeds.push(("motor.xlsx".to_owned(), workbook()));
    seeds.sort();
    for round in 0..8 {
        for (name, bytes) in &seeds {
            let mut mutant = bytes.clone();
            for _ in 0..=round {
                let (from, to) = (random(mutant.len()), random(mutant.len()));
                match random(4) {
                    0 => mutant.truncate(from),
                    1 => mutant.extend_from_within(from.min(to)..from.max(to)),
                    2 => drop(mutant.drain(from.min(to)..from.max(to).min(from.min(to) + 9))),
                    _ => {
                        let sign = b";,|<>\t\"'0h-./&#1x \n\xFF"[random(20)];
                        mutant.insert(from, sign);
                    }
                }
            }
            made(name, mutant, None);
        }
    }
}
