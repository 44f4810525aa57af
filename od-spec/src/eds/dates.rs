//! Dates and times of `[FileInfo]` (CiA 306 3.2): `05-27-2009`, `09:00AM`.

use crate::model::Date;

/// A date as the standard writes it, `mm-dd-yyyy`; the day has to exist.
pub(crate) fn date(text: &str) -> Option<Date> {
    let mut parts = text.split('-');
    let (month, day, year) = (parts.next()?, parts.next()?, parts.next()?);
    let widths = (month.len(), day.len(), year.len());
    (widths == (2, 2, 4) && parts.next().is_none())
        .then(|| Date::of(number(year)?, number(month)?, number(day)?))?
}

/// A time as the standard writes it, `hh:mmAM`: hour (0 to 23) and minute.
pub(crate) fn time(text: &str) -> Option<(u8, u8)> {
    let text = text.to_ascii_uppercase();
    let (clock, half) = match (text.strip_suffix("AM"), text.strip_suffix("PM")) {
        (Some(clock), _) => (clock, 0),
        (None, Some(clock)) => (clock, 12),
        (None, None) => return None,
    };
    let (hour, minute) = clock.trim_end().split_once(':')?;
    let (hour, minute) = (small(hour)?, small(minute)?);
    ((1..=12).contains(&hour) && minute < 60).then_some((hour % 12 + half, minute))
}

fn number(digits: &str) -> Option<u16> {
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    digits.parse().ok().filter(|_| is_number)
}

fn small(digits: &str) -> Option<u8> {
    number(digits).filter(|_| digits.len() == 2).and_then(|number| u8::try_from(number).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times_are_those_of_the_standard() {
        assert_eq!(date("05-27-2009"), Some(Date { year: 2009, month: 5, day: 27 }));
        assert_eq!(date("02-29-2024").map(|date| date.day), Some(29));
        for text in
            ["2009-05-27", "5-27-2009", "27-05-2009", "02-29-2023", "02-30-2024", "13-01-2020", "", "a-b-c"]
        {
            assert_eq!(date(text), None, "{text}");
        }
        for (text, at) in
            [("12:00AM", (0, 0)), ("09:05AM", (9, 5)), ("12:30PM", (12, 30)), ("11:59 pm", (23, 59))]
        {
            assert_eq!(time(text), Some(at), "{text}");
        }
        for text in ["13:51", "17:27PM", "00:10AM", "9:45AM", "09:60AM", "", "AM"] {
            assert_eq!(time(text), None, "{text}");
        }
    }
}
