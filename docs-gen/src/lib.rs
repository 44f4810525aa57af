//! Will hold the documentation backend, which prints the manual's tables from the resolved model; empty for now.
