//! What an EDS leaves open and code cannot do without: names that differ, and how long a text may be.
//!
//! The author of a specification is asked to decide. For an EDS there is no one to ask, so it is decided here, always
//! in the same way.

mod names;
mod units;

use std::borrow::Cow;

use od_spec::model::{Access, Dictionary, Entry, Fact, Family, Statement, System, SystemSource};

use super::Language;

/// The capacity of a text whose EDS shows no longer one, in bytes.
const LEAST_CAPACITY: u16 = 32;

/// The device as code can have it: of a specification as it is; of an EDS with names that differ and with capacities.
pub fn decided<'a>(system: &System, device: &'a Dictionary, language: &dyn Language) -> Cow<'a, Dictionary> {
    match system.source {
        SystemSource::Specification => Cow::Borrowed(device),
        SystemSource::Eds => Cow::Owned(decided_anyhow(device, language)),
    }
}

/// Gives an identifier to every object and entry that would share one in code.
pub fn tell_apart(device: &mut Dictionary, language: &dyn Language) {
    names::tell_apart(device, language);
}

/// The device with names that differ and with capacities, whatever it was read from: where names are not visible, no
/// one is asked for one.
pub fn decided_anyhow(device: &Dictionary, language: &dyn Language) -> Dictionary {
    let mut device = device.clone();
    names::tell_apart(&mut device, language);
    units::tell_apart(&mut device, language);
    for entry in device.objects.values_mut().flat_map(|object| &mut object.entries) {
        if let Some(capacity) = capacity(entry).filter(|_| entry.capacity.is_none()) {
            entry.capacity = Some(capacity);
            entry.facts.state(Fact::Capacity, Statement::derived(entry.span));
        }
    }
    device
}

/// The capacity of a text or of bytes: as long as the default, and at least [`LEAST_CAPACITY`]. A constant has its own length,
/// and a default that is longer than any text of a dictionary is left for the layout to refuse.
fn capacity(entry: &Entry) -> Option<u16> {
    let has_capacity = match entry.data_type.family() {
        Family::VisibleString | Family::OctetString | Family::UnicodeString => true,
        Family::Boolean
        | Family::Signed
        | Family::Unsigned
        | Family::Real
        | Family::Time
        | Family::Domain => false,
    };
    let length =
        entry.default.as_ref().and_then(|value| value.bytes_for(entry.data_type, 0)).map(|bytes| bytes.len());
    match (has_capacity, entry.access, length) {
        (false, ..) | (true, Access::Const, Some(_)) => None,
        (true, _, length) => u16::try_from(length.unwrap_or(0)).ok().map(|length| length.max(LEAST_CAPACITY)),
    }
}

#[cfg(test)]
mod tests {
    use od_spec::diag::Diagnostics;
    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};

    use crate::plan::{Place, Shape, plan};
    use crate::rust::Rust;

    use super::*;

    fn system(sections: &str) -> System {
        let head = "[DeviceInfo]\nProductName=Thing\n";
        let mut sources = SourceMap::new();
        let root = sources.add("thing.eds", format!("{head}{sections}"));
        compile(&mut sources, root, &mut NoFiles).system.unwrap()
    }

    fn var(index: &str, name: &str, rest: &str) -> String {
        format!("[{index}]\nParameterName={name}\nObjectType=7\nDataType=5\nAccessType=rw\n{rest}\n")
    }

    /// The names of all entries, in the order of the table.
    fn names(sections: &str) -> Vec<String> {
        let system = system(sections);
        let device = decided(&system, &system.devices[0], &Rust);
        let mut diagnostics = Diagnostics::new();
        let plan = plan(&system, &device, &Rust, &mut diagnostics);
        assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        plan.entries.iter().map(|entry| entry.name.clone()).collect()
    }

    #[test]
    fn names_that_would_clash_get_their_index() {
        let twice = [var("2000", "Speed", ""), var("2001", "speed", ""), var("2002", "torque", "")].concat();
        assert_eq!(names(&twice), ["speed_2000", "speed_2001", "torque"]);
        let setter = [var("2000", "set x", ""), var("2001", "x", "")].concat();
        assert_eq!(names(&setter), ["set_x_2000", "x_2001"]);
        // The index of one is already in the name of another.
        let taken = [var("2000", "a", ""), var("2001", "a", ""), var("2002", "a 2000", "")].concat();
        assert_eq!(names(&taken), ["object_2000", "a_2001", "a_2000_2002"]);
    }

    #[test]
    fn what_has_no_letter_is_called_by_its_index() {
        assert_eq!(names(&var("2000", "---", "")), ["object_2000"]);
        let reserved =
            [var("2000", "entry", ""), var("2001", "?", ""), var("2002", "object 2001", "")].concat();
        assert_eq!(names(&reserved), ["entry", "object_2001", "object_2001_2002"]);
    }

    #[test]
    fn entries_that_would_clash_get_their_sub_index() {
        let record = "[2000]\nParameterName=r\nObjectType=9\nSubNumber=3\n";
        let sub = |sub: u8, name: &str| {
            format!("[2000sub{sub}]\nParameterName={name}\nObjectType=7\nDataType=5\nAccessType=rw\n")
        };
        let text =
            [record.to_owned(), sub(0, "count"), sub(1, "value"), sub(2, "Value"), sub(3, "%")].concat();
        assert_eq!(names(&text), ["r_count", "r_value_1", "r_value_2", "r_sub_3"]);
    }

    #[test]
    fn an_entry_that_a_pdo_maps_twice_has_two_names() {
        let record = |index: &str, subs: &[(&str, &str)]| {
            let head = format!("[{index}]\nParameterName=p{index}\nObjectType=9\n");
            let sub = |(sub, (data_type, value)): (usize, &(&str, &str))| {
                format!(
                    "[{index}sub{sub}]\nParameterName=s{sub}\nObjectType=7\nDataType={data_type}\nAccessType=rw\n\
                     DefaultValue={value}\n"
                )
            };
            head + &subs.iter().enumerate().map(sub).collect::<String>()
        };
        let text = var("2000", "x", "PDOMapping=1")
            + &record("1A00", &[("5", "2"), ("7", "0x20000008"), ("7", "0x20000008")])
            + &record("1800", &[("5", "2"), ("7", "$NODEID+0x180"), ("5", "254")]);
        let system = system(&text);
        let device = decided(&system, &system.devices[0], &Rust);
        let mut diagnostics = Diagnostics::new();
        let plan = plan(&system, &device, &Rust, &mut diagnostics);
        assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        let fields: Vec<&str> = plan.pdos[0].fields.iter().map(|field| field.name.as_str()).collect();
        assert_eq!(fields, ["x", "x_2"]);
    }

    #[test]
    fn the_number_of_elements_has_a_name_of_its_own() {
        let entry = |sub: u8, name: &str| {
            format!("[2000sub{sub}]\nParameterName={name}\nObjectType=7\nDataType=5\nAccessType=rw\n")
        };
        let text = "[2000]\nParameterName=list\nObjectType=8\n".to_owned()
            + &[entry(0, "%"), entry(1, "element 1"), entry(2, "element 2")].concat();
        let system = system(&text);
        let device = decided(&system, &system.devices[0], &Rust);
        let mut diagnostics = Diagnostics::new();
        let plan = plan(&system, &device, &Rust, &mut diagnostics);
        assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        let names = plan.objects.iter().map(|object| match &object.shape {
            Shape::Indexed { count } => (object.name.as_str(), count.as_deref()),
            Shape::Var | Shape::Group { .. } => (object.name.as_str(), None),
        });
        assert_eq!(names.collect::<Vec<_>>(), [("list", Some("list_sub_0"))]);
    }

    #[test]
    fn texts_have_room_for_their_default_and_for_32_bytes() {
        let text = |default: &str| {
            let object = "[2000]\nParameterName=t\nObjectType=7\nDataType=9\nAccessType=rw\n";
            let system = system(&format!("{object}DefaultValue={default}\n"));
            let device = decided(&system, &system.devices[0], &Rust);
            let mut diagnostics = Diagnostics::new();
            let plan = plan(&system, &device, &Rust, &mut diagnostics);
            assert!(!diagnostics.has_errors(), "{diagnostics:?}");
            assert!(matches!(plan.entries[0].place, Place::Image(_)));
            plan.entries[0].size
        };
        assert_eq!((text(""), text("short"), text(&"x".repeat(40))), (32, 32, 40));
    }

    #[test]
    fn units_have_names_that_differ() {
        let object =
            |index: &str, unit: &str| format!("; unit {unit}\n{}", var(index, &format!("v{index}"), ""));
        let text =
            [object("2000", "%"), object("2001", "m/s"), object("2002", "m s"), object("2003", "V")].concat();
        let system = system(&text);
        let device = decided(&system, &system.devices[0], &Rust);
        let mut diagnostics = Diagnostics::new();
        let plan = plan(&system, &device, &Rust, &mut diagnostics);
        assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        let names: Vec<&str> = plan.units.iter().map(|unit| unit.name.as_str()).collect();
        assert_eq!(names, ["V", "MS1", "MS2", "Percent"]);
    }

    #[test]
    fn a_specification_decides_itself() {
        let text = "od-spec: 1\ntitle: T\nuses: [cia301]\ndevices: {d: {name: D, bit-rates: [125]}}\nobjects:\n  \
                    0x2000: {name: a, type: unsigned8, access: rw}\n  0x2001: {name: A, type: unsigned8, access: rw}\n";
        let mut sources = SourceMap::new();
        let root = sources.add("d.od.yaml", text);
        let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
        assert!(matches!(decided(&system, &system.devices[0], &Rust), Cow::Borrowed(_)));
    }
}
