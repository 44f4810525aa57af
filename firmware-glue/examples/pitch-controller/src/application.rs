//! The application: a simulated axis, its state machine, one fault, and parameters that are kept.
//!
//! The dictionary has checked what comes over the bus before it gets here: types, limits, access, write conditions. What is left is
//! what only the application can know.

use firmware_glue::clock::{Duration, Instant};
use firmware_glue::emcy::Emergency;
use firmware_glue::lss::LssHandler;
use firmware_glue::node::{NodeHandler, Reset};
use firmware_glue::pdo::engine::PdoHandler;
use firmware_glue::state_machine::{Cause, StateHandler, StateMachine};
use firmware_glue::storage::{ALL, Command, ParameterStore};
use firmware_glue::{AbortCode, Application, NodeId, Storage};

use crate::flash::RamFlash;
use crate::pmc::machines::{PowerDriveCommand, PowerDriveState, PowerDriveTransition as Transition};
use crate::pmc::types::{Controlword, ModesOfOperation, StoreCapability};
use crate::pmc::{Entry, Pmc, errors, units};

/// Where parameters are kept.
pub type Store<'m> = ParameterStore<RamFlash<'m>, 64>;

/// What a client reads of 1010h and 1011h: the device does it on command.
const ON_COMMAND: StoreCapability = StoreCapability(0).with_saves_on_command(true);
/// The simulation goes on in steps of this time.
const STEP: Duration = Duration::from_millis(10);
/// Steps in a second: speeds are reported per second.
const STEPS_PER_SECOND: u32 = 100;
/// The DC link of the bench, which never changes.
const DC_LINK: units::Millivolt<u32> = units::Millivolt(560_000);
const DC_LINK_VOLTS: u16 = 560;

/// What the main loop reports to the node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Report {
    /// An error has occurred.
    Raised(Emergency),
    /// An error, by its code, has been acknowledged.
    Cleared(u16),
}

/// A drive.
#[derive(Debug)]
pub struct Drive<'m> {
    store: Store<'m>,
    machine: StateMachine<PowerDriveState>,
    /// As it was before the last write, for bits that act on a change.
    controlword: Controlword,
    target: i32,
    /// What a step has left of a position unit, in parts of [`STEPS_PER_SECOND`].
    rest: u32,
    stepped: Instant,
    /// The error that was reported to the node.
    reported: Option<u16>,
    #[cfg(feature = "names")]
    console: crate::uart::Uart,
}

impl<'m> Drive<'m> {
    /// A drive that is switched on.
    pub fn new(store: Store<'m>) -> Self {
        Self {
            store,
            machine: StateMachine::new(),
            controlword: Controlword(0),
            target: 0,
            rest: 0,
            stepped: Instant::ZERO,
            reported: None,
            #[cfg(feature = "names")]
            console: crate::uart::Uart::Console.open(),
        }
    }

    /// Goes on with the simulation, and shows it in the dictionary.
    pub fn step(&mut self, od: &mut Pmc, now: Instant) {
        if now.since(self.stepped) >= STEP {
            self.stepped = now;
            let velocity = self.travel(od);
            od.set_actual_velocity(units::PositionUnitPerSecond(velocity));
        }
        // What the drive does by itself: it initialises, ends a quick stop, is done with the reaction to a fault.
        self.machine.step(od, &mut Guards);
        let is_at_target = od.position_actual_value().0 == self.target;
        let has_voltage = match self.machine.state() {
            PowerDriveState::SwitchedOn
            | PowerDriveState::OperationEnabled
            | PowerDriveState::QuickStopActive
            | PowerDriveState::FaultReactionActive => true,
            PowerDriveState::NotReadyToSwitchOn
            | PowerDriveState::SwitchOnDisabled
            | PowerDriveState::ReadyToSwitchOn
            | PowerDriveState::Fault => false,
        };
        // The bits of the state are the machine's.
        od.set_statusword(
            od.statusword()
                .with_voltage_enabled(has_voltage)
                .with_remote(true)
                .with_target_reached(is_at_target)
                .with_manufacturer_specific(od.controlword().manufacturer_specific()),
        );
    }

    /// The travel of one step towards the target; the velocity.
    fn travel(&mut self, od: &mut Pmc) -> i32 {
        let position = od.position_actual_value().0;
        let distance = self.target.saturating_sub(position);
        let may_move = self.machine.state() == PowerDriveState::OperationEnabled && !od.controlword().halt();
        if !may_move || distance == 0 {
            self.rest = 0;
            return 0;
        }
        let velocity = od.profile_velocity().0.min(od.max_profile_velocity().0);
        let parts = self.rest.saturating_add(velocity);
        self.rest = parts % STEPS_PER_SECOND;
        let travelled =
            i32::try_from((parts / STEPS_PER_SECOND).min(distance.unsigned_abs())).unwrap_or(i32::MAX);
        let sign = distance.signum();
        od.set_position_actual_value(units::PositionUnit(
            position.saturating_add(travelled.saturating_mul(sign)),
        ));
        i32::try_from(velocity).unwrap_or(i32::MAX).saturating_mul(sign)
    }

    /// Looks for errors. The one that this drive has: the DC link is below its lowest voltage (6510h.4), as a client can set it.
    pub fn supervise(&mut self, od: &mut Pmc, now: Instant) -> Option<Report> {
        match self.reported {
            None if is_under_voltage(od) => {
                // From any state; one that is a fault already stays.
                let _ = self.machine.event(od, &mut Guards, Transition::T13);
                let code = errors::UNDER_VOLTAGE_IN_THE_DC_LINK;
                self.reported = Some(code);
                od.set_error_code(code);
                // In milliseconds since power-on; 1003h is the node's affair.
                let [a, b, c, d, ..] = now.as_micros().saturating_div(1000).to_le_bytes();
                let _ = od.set_error_field_time_stamp(1, u32::from_le_bytes([a, b, c, d]));
                Some(Report::Raised(Emergency::new(code)))
            }
            Some(code) if !self.is_in_fault() => {
                self.reported = None;
                od.set_error_code(errors::NO_ERROR);
                Some(Report::Cleared(code))
            }
            None | Some(_) => None,
        }
    }

    fn is_in_fault(&self) -> bool {
        matches!(self.machine.state(), PowerDriveState::FaultReactionActive | PowerDriveState::Fault)
    }

    /// Does what the controlword says.
    fn obey(&mut self, od: &mut Pmc) {
        self.machine.step(od, &mut Guards);
        let (word, before) = (od.controlword(), self.controlword);
        self.controlword = word;
        if PowerDriveCommand::StartNewPosition.is_given(before, word)
            && od.modes_of_operation_display() == ModesOfOperation::PROFILE_POSITION_MODE
        {
            let limits = od.software_position_limit();
            let lowest = limits.min_position_limit().0;
            self.target = od.target_position().0.max(lowest).min(limits.max_position_limit().0);
        }
    }
}

/// Which transitions may be made now. The enable input of this drive is always on, and the EFC signal never comes.
struct Guards;

impl StateHandler<PowerDriveState> for Guards {
    fn may(&mut self, od: &Pmc, transition: Transition, cause: Cause) -> bool {
        match transition {
            // By itself, when the quick stop is over.
            Transition::T12 => cause == Cause::Command || od.actual_velocity().0 == 0,
            // No error is pending.
            Transition::T15 => !is_under_voltage(od),
            // The EFC signal alone.
            Transition::T16 => false,
            _ => true,
        }
    }
}

impl Application<Pmc> for Drive<'_> {
    fn command(&mut self, od: &mut Pmc, command: Command) -> Result<(), AbortCode> {
        self.store.command(od, command).map(drop).map_err(AbortCode::from)
    }

    fn changed(&mut self, od: &mut Pmc, entry: Entry) {
        match entry {
            Entry::Controlword => self.obey(od),
            Entry::ModesOfOperation => od.set_modes_of_operation_display(od.modes_of_operation()),
            _ => {}
        }
        #[cfg(feature = "names")]
        crate::names::print(&mut self.console, entry);
    }
}

impl PdoHandler<Pmc> for Drive<'_> {}

/// This device has no LSS, so that nothing of it is called.
impl LssHandler for Drive<'_> {}

impl NodeHandler<Pmc> for Drive<'_> {
    fn restart(&mut self, od: &mut Pmc, node: NodeId, reset: Reset) {
        let groups: &[Storage] = match reset {
            Reset::Node => &ALL,
            Reset::Communication => &[Storage::Communication],
        };
        self.store.load(od, node, groups);
        let mut store = od.store_parameters_mut();
        store.set_save_all_parameters(ON_COMMAND);
        store.set_save_communication_parameters(ON_COMMAND);
        store.set_save_application_parameters(ON_COMMAND);
        // A real one reads it from its factory data.
        od.identity_object_mut().set_serial_number(4711);
        if reset == Reset::Node {
            self.machine = StateMachine::new();
            self.machine.start(od);
            self.controlword = Controlword(0);
            self.target = 0;
            self.rest = 0;
            self.reported = None;
            od.set_dc_link_circuit_voltage(DC_LINK);
        }
    }
}

fn is_under_voltage(od: &Pmc) -> bool {
    DC_LINK_VOLTS < od.drive_data().min_dc_link_voltage().0
}
