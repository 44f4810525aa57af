//! Dates and times of `[FileInfo]` (CiA 306 4.4): `05-27-2009`, `09:00AM`, and every other notation that cannot be misunderstood.

use crate::model::Date;

const MONTHS: [&str; 12] =
    ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];

/// Reads a date whose order is certain: that of the standard, `mm-dd-yyyy`, with the year in front, with the name of a month,
/// or with a day above 12. The day has to exist.
pub(crate) fn date(text: &str) -> Option<Date> {
    let separator = ['-', '/', '.'].into_iter().find(|sign| text.contains(*sign))?;
    let mut parts = text.split(separator).map(str::trim);
    let (first, second, third) = (parts.next()?, parts.next()?, parts.next()?);
    if parts.next().is_some() {
        return None;
    }
    let of = |year: u16, month, day| Date::of(year, month, day).filter(|_| (1000..=9999).contains(&year));
    if first.len() == 4 {
        return of(number(first)?, number(second)?, number(third)?);
    }
    let year = number(third).filter(|_| third.len() == 4)?;
    if let Some(month) = month(second) {
        return of(year, month, number(first)?);
    }
    let (one, two) = (number(first)?, number(second)?);
    match (one, two) {
        (13.., _) => of(year, two, one),
        (_, 13..) => of(year, one, two),
        // With dashes it is the order of the standard; with anything else it is unknown.
        _ if separator == '-' || one == two => of(year, one, two),
        _ => None,
    }
}

/// A date as the standard has it, `mm-dd-yyyy`.
pub fn date_text(date: Date) -> String {
    format!("{:02}-{:02}-{:04}", date.month, date.day, date.year)
}

/// Reads a time of 12 hours with AM or PM, or of 24 hours without: hour (0 to 23) and minute. Seconds are left out, as the
/// standard has none.
pub(crate) fn time(text: &str) -> Option<(u8, u8)> {
    let upper = text.to_ascii_uppercase();
    let half = ["AM", "PM"].into_iter().find_map(|half| Some((upper.strip_suffix(half)?.trim_end(), half)));
    let mut parts = half.map_or(upper.as_str(), |(digits, _)| digits).split(':');
    let (hour, minute) = (number(parts.next()?)?, number(parts.next()?).filter(|minute| *minute < 60)?);
    let has_seconds = parts.next().is_none_or(|seconds| number(seconds).is_some_and(|seconds| seconds < 60));
    if !has_seconds || parts.next().is_some() {
        return None;
    }
    let hour = match (half, hour) {
        (None, 0..=23) => hour,
        (Some((_, "AM")), 0..=11) => hour,
        (Some((_, "AM")), 12) => 0,
        (Some((_, "PM")), 1..=11) => hour + 12,
        // A time of 24 hours that says once more that it is after noon.
        (Some((_, "PM")), 12..=23) => hour,
        _ => return None,
    };
    Some((u8::try_from(hour).ok()?, u8::try_from(minute).ok()?))
}

/// A time as the standard has it, `hh:mmAM`, of an hour (0 to 23) and a minute.
pub fn time_text((hour, minute): (u8, u8)) -> String {
    let half = if hour < 12 { "AM" } else { "PM" };
    let hour = match hour % 12 {
        0 => 12,
        hour => hour,
    };
    format!("{hour:02}:{minute:02}{half}")
}

/// One to four digits.
fn number(text: &str) -> Option<u16> {
    let is_number = (1..=4).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_digit());
    text.parse().ok().filter(|_| is_number)
}

/// An English name of a month, or its first three letters.
fn month(name: &str) -> Option<u16> {
    let is_word = name.len() >= 3 && name.bytes().all(|byte| byte.is_ascii_alphabetic());
    let short = name.get(..3).filter(|_| is_word)?.to_ascii_lowercase();
    let at = MONTHS.iter().position(|month| *month == short)?;
    u16::try_from(at + 1).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_read_where_they_are_certain() {
        for (text, written) in [
            ("02-07-2016", "02-07-2016"),
            ("2016-02-07", "02-07-2016"),
            ("07-Feb-2016", "02-07-2016"),
            ("17/07/2024", "07-17-2024"),
            ("15-02-2019", "02-15-2019"),
            ("04-4-2018", "04-04-2018"),
            ("02-29-2020", "02-29-2020"),
            ("12/31/1999", "12-31-1999"),
        ] {
            assert_eq!(date(text).map(date_text).as_deref(), Some(written), "{text}");
        }
        for text in [
            "",
            "01-08-26",
            "02/03/2020",
            "02.03.2020",
            "02-30-2020",
            "13-13-2020",
            "x-y-z",
            "2020",
            "02-29-2021",
        ] {
            assert_eq!(date(text), None, "{text}");
        }
    }

    #[test]
    fn times_are_read_where_they_are_certain() {
        for (text, written) in [
            ("09:45AM", "09:45AM"),
            ("12:00AM", "12:00AM"),
            ("12:30PM", "12:30PM"),
            ("9:45am", "09:45AM"),
            ("08:55 PM", "08:55PM"),
            ("13:51", "01:51PM"),
            ("00:07", "12:07AM"),
            ("12:05:34", "12:05PM"),
            ("17:27PM", "05:27PM"),
            ("00:30AM", "12:30AM"),
        ] {
            assert_eq!(time(text).map(time_text).as_deref(), Some(written), "{text}");
        }
        for text in ["", "17:27AM", "00:30PM", "24:00", "12:60", "12", "1:2:3:4", "ab:cd"] {
            assert_eq!(time(text), None, "{text}");
        }
    }
}
