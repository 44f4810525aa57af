//! Switches with a hysteresis: the values at which something goes on, and off again.

use super::{Dictionary, EntryId, Ratio, Text, Unit};

/// What is switched by the value of a quantity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Switch {
    /// What goes on.
    pub what: Text,
    /// On which side of the threshold it goes on.
    pub side: SwitchSide,
    /// Entry with the threshold.
    pub threshold: EntryId,
    /// What says where it goes off again.
    pub back: SwitchBack,
}

/// On which side of its threshold a [`Switch`] goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwitchSide {
    /// Below it.
    Below,
    /// Above it.
    Above,
}

/// Where a [`Switch`] goes off again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwitchBack {
    /// This far past the threshold, seen from where it is on.
    By(EntryId),
    /// At this value.
    At(EntryId),
}

impl SwitchBack {
    /// The entry that says it.
    pub const fn entry(self) -> EntryId {
        match self {
            Self::By(id) | Self::At(id) => id,
        }
    }
}

/// The values at which a [`Switch`] goes on and off, in the basic symbol of the threshold's unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SwitchPoints {
    /// Beyond this value it goes on.
    pub on: Ratio,
    /// At this value it goes off again.
    pub off: Ratio,
}

impl Switch {
    /// The values that the defaults of a device give; nothing where an entry has no whole number in a unit as its default.
    pub fn points(&self, device: &Dictionary) -> Option<SwitchPoints> {
        let number = |id: EntryId| {
            let entry = device.entry(id)?;
            Some((entry.unit.as_deref()?, entry.default.as_ref()?.integer()?))
        };
        let (unit, raw) = number(self.threshold)?;
        let on = unit.quantity(raw)?;
        let (unit, raw) = number(self.back.entry())?;
        let off = match (self.back, self.side) {
            (SwitchBack::At(_), SwitchSide::Below | SwitchSide::Above) => unit.quantity(raw)?,
            (SwitchBack::By(_), SwitchSide::Below) => on.checked_add(difference(unit, raw)?)?,
            (SwitchBack::By(_), SwitchSide::Above) => on.checked_sub(difference(unit, raw)?)?,
        };
        Some(SwitchPoints { on, off })
    }
}

/// What a raw value represents as a difference of two values: where its unit counts from does not matter.
fn difference(unit: &Unit, raw: i128) -> Option<Ratio> {
    Ratio::whole(raw).checked_mul(unit.step()?)
}
