//! Tests of the printed text; what it does on a controller, tests/readers/st.py evaluates.
