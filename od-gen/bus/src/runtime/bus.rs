//! Nodes on one bus, inside a program.

use std::collections::VecDeque;

use firmware_glue::frame::Frame;

use super::VirtualNode;

/// Nodes that hear each other. Frames of others go in, and everything that is on the bus then comes out, in its order.
#[derive(Debug)]
pub struct Bus<'t> {
    nodes: Vec<VirtualNode<'t>>,
}

impl<'t> Bus<'t> {
    /// A bus with nodes.
    pub const fn new(nodes: Vec<VirtualNode<'t>>) -> Self {
        Self { nodes }
    }

    /// Takes a frame of another participant; returns it and what answers it.
    pub fn take(&mut self, frame: Frame, now: u64) -> Vec<Frame> {
        self.spread(VecDeque::from([(None, frame)]), now)
    }

    /// What the nodes say by themselves: boot-up messages, heartbeats, emergencies, PDOs, segments of blocks. To be called until it is
    /// nothing, at the beginning and after every frame.
    pub fn poll(&mut self, now: u64) -> Vec<Frame> {
        let own = self.nodes.iter_mut().enumerate();
        let frames =
            own.flat_map(|(at, node)| node.poll(now).into_iter().map(move |frame| (Some(at), frame)));
        let frames = frames.collect();
        self.spread(frames, now)
    }

    /// Its nodes, in the order in which they were given.
    pub fn nodes(&self) -> &[VirtualNode<'t>] {
        &self.nodes
    }

    /// Its nodes, in the order in which they were given.
    pub fn nodes_mut(&mut self) -> &mut [VirtualNode<'t>] {
        &mut self.nodes
    }

    /// When a node has something to say next, unless a frame comes before.
    pub fn next_deadline(&self) -> Option<u64> {
        self.nodes.iter().filter_map(VirtualNode::next_deadline).min()
    }

    /// Brings frames to all nodes but their senders, with what these say to it.
    fn spread(&mut self, mut open: VecDeque<(Option<usize>, Frame)>, now: u64) -> Vec<Frame> {
        let mut seen = Vec::new();
        while let Some((sender, frame)) = open.pop_front() {
            for (at, node) in self.nodes.iter_mut().enumerate().filter(|(at, _)| Some(*at) != sender) {
                open.extend(node.take(&frame, now).into_iter().map(|answer| (Some(at), answer)));
            }
            seen.push(frame);
        }
        seen
    }
}
