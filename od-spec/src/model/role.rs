//! What an object is, whatever file describes it: this follows from its index.

use super::{Index, Object};

/// What an object of the communication profile is for (CiA 301 v4.2, 7.5.2), or the area that it lies in (CiA 301 v4.02, 9.5.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// 1000h: device profile and type (7.5.2.1).
    DeviceType,
    /// 1001h: error register (7.5.2.2).
    ErrorRegister,
    /// 1003h: the errors that occurred last (7.5.2.4).
    ErrorHistory,
    /// 1010h: commands that store parameters (7.5.2.13).
    StoreParameters,
    /// 1011h: commands that restore the defaults (7.5.2.14).
    RestoreDefaults,
    /// 1018h: identity (7.5.2.21).
    Identity,
    /// 1200h to 127Fh: parameter of an SDO server (7.5.2.33).
    SdoServer,
    /// 1280h to 12FFh: parameter of an SDO client (7.5.2.34).
    SdoClient,
    /// 1400h to 15FFh and 1800h to 19FFh: communication parameter of a PDO (7.5.2.35, 7.5.2.37).
    PdoCommunication,
    /// 1600h to 17FFh and 1A00h to 1BFFh: mapping parameter of a PDO (7.5.2.36, 7.5.2.38).
    PdoMapping,
    /// Any other object from 1000h to 1FFFh.
    Communication,
    /// 2000h to 5FFFh: the maker's own.
    Manufacturer,
    /// 6000h to 9FFFh: a device profile's.
    DeviceProfile,
    /// A000h to BFFFh: an interface profile's and system variables.
    InterfaceProfile,
    /// Data types (0001h to 0FFFh) and what is reserved.
    Reserved,
}

impl Role {
    /// The role of the object at an index.
    pub const fn of(index: Index) -> Self {
        match index.0 {
            0x1000 => Self::DeviceType,
            0x1001 => Self::ErrorRegister,
            0x1003 => Self::ErrorHistory,
            0x1010 => Self::StoreParameters,
            0x1011 => Self::RestoreDefaults,
            0x1018 => Self::Identity,
            0x1200..=0x127F => Self::SdoServer,
            0x1280..=0x12FF => Self::SdoClient,
            0x1400..=0x15FF | 0x1800..=0x19FF => Self::PdoCommunication,
            0x1600..=0x17FF | 0x1A00..=0x1BFF => Self::PdoMapping,
            0x1002
            | 0x1004..=0x100F
            | 0x1012..=0x1017
            | 0x1019..=0x11FF
            | 0x1300..=0x13FF
            | 0x1C00..=0x1FFF => Self::Communication,
            0x2000..=0x5FFF => Self::Manufacturer,
            0x6000..=0x9FFF => Self::DeviceProfile,
            0xA000..=0xBFFF => Self::InterfaceProfile,
            0x0000..=0x0FFF | 0xC000..=0xFFFF => Self::Reserved,
        }
    }

    /// Whether it is a parameter object of a PDO, which follows from the PDO.
    pub const fn is_pdo_parameter(self) -> bool {
        matches!(self, Self::PdoCommunication | Self::PdoMapping)
    }
}

impl Object {
    /// What the object is.
    pub const fn role(&self) -> Role {
        Role::of(self.index)
    }
}

impl Index {
    /// Whether it lies in the communication profile's area, 1000h to 1FFFh (CiA 301 v4.02, 9.5.2).
    pub const fn is_communication_profile(self) -> bool {
        matches!(self.0, 0x1000..=0x1FFF)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_areas_follow_each_other_without_a_gap() {
        let mut runs: Vec<(u16, Role)> = Vec::new();
        for index in 0..=u16::MAX {
            let role = Role::of(Index(index));
            if runs.last().is_none_or(|(_, last)| *last != role) {
                runs.push((index, role));
            }
        }
        let of = |role: Role| {
            runs.iter().filter(|(_, one)| *one == role).map(|(start, _)| *start).collect::<Vec<_>>()
        };
        assert_eq!(of(Role::PdoCommunication), [0x1400, 0x1800]);
        assert_eq!(of(Role::PdoMapping), [0x1600, 0x1A00]);
        assert_eq!(of(Role::SdoServer), [0x1200]);
        assert_eq!(of(Role::SdoClient), [0x1280]);
        assert_eq!(of(Role::Identity), [0x1018]);
        assert_eq!(of(Role::Manufacturer), [0x2000]);
        assert_eq!(of(Role::DeviceProfile), [0x6000]);
        assert_eq!(of(Role::Reserved), [0x0000, 0xC000]);
        let communication = (0..=u16::MAX).filter(|index| Index(*index).is_communication_profile());
        assert_eq!(communication.count(), 0x1000);
    }
}
