//! Will hold the `no_std` run-time half of generated dictionaries: lookup, checked access, PDO mapping; empty for now.
#![no_std]
