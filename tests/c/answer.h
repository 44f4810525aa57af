/*
 * Requests to a dictionary as bytes, and its answers: the same on the host and on an emulated
 * Cortex-M. tests/src/c_dictionary/protocol.rs has the same in Rust.
 *
 * A request is an operation and what it needs, an answer a code of 4 bytes, the calls of the
 * application (number in 2 bytes; kind, row of each), and the bytes of a value. Numbers are least
 * significant byte first.
 */
#ifndef ANSWER_H
#define ANSWER_H

#include <stddef.h>
#include <stdint.h>

/** Bytes that every answer fits into. */
#define LONGEST_ANSWER (80000U)

/** Answers a request; the number of bytes of the answer. */
size_t answer(const uint8_t *request, size_t length, uint8_t *bytes);

#endif /* ANSWER_H */
