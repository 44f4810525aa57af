/*
 * The SDO server of the book, which answers frames: a request has eight bytes, an answer eight or none. A request of one byte starts the node with this ID.
 */
#include "answer.h"

#include <stdbool.h>

void sdo_start(uint8_t node_id);
bool sdo_answer(const uint8_t request[8], uint8_t answer[8]);

size_t answer(const uint8_t *request, size_t length, uint8_t *bytes)
{
    size_t count = 0U;
    if (length == 1U) {
        sdo_start(request[0]);
    } else if (sdo_answer(request, bytes)) {
        count = 8U;
    } else {
        /* An abort has no answer. */
    }
    return count;
}
