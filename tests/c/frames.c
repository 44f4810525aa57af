/*
 * Takes frames of PDOs apart and puts them together: frames.inc has a line for each PDO, and one for each field that an entry has.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include DEVICE_HEADER

static DICTIONARY od;
static uint8_t before[8];
static uint8_t after[8];
static uint32_t state = 1U;

static uint8_t random_byte(void)
{
    state = (state * 1664525U) + 1013904223U;
    return (uint8_t)(state >> 24);
}

static void fill(uint8_t *bytes, size_t length)
{
    size_t at;
    for (at = 0U; at < length; at++) {
        bytes[at] = random_byte();
    }
}

static void fail(const char *what)
{
    (void)printf("%s\n", what);
    exit(1);
}

/** What a frame carries is what is put into it, as far as it is long; a BOOLEAN and what is between values may differ. */
#define FRAME(name, bytes)                                                                  \
    for (turn = 0U; turn < 20U; turn++) {                                                   \
        name##_t values;                                                                    \
        name##_t again;                                                                     \
        (void)memset(&values, 0, sizeof(values));                                           \
        (void)memset(&again, 0, sizeof(again));                                             \
        fill(before, sizeof(before));                                                       \
        name##_unpack(&values, before);                                                     \
        name##_pack(&values, after);                                                        \
        name##_unpack(&again, after);                                                       \
        for (at = 0U; at < sizeof(after); at++) {                                           \
            if ((at >= (bytes)) ? (after[at] != 0U) : ((after[at] & (uint8_t)~before[at]) != 0U)) { \
                fail(#name);                                                                \
            }                                                                               \
        }                                                                                   \
        if (memcmp(&values, &again, sizeof(values)) != 0) {                                 \
            fail(#name);                                                                    \
        }                                                                                   \
    }

/** A field of a TPDO is what its entry is. */
#define CARRIED(name, number, field, get)                                                   \
    {                                                                                       \
        name##_t values;                                                                    \
        uint8_t packed;                                                                     \
        od_reset(&TABLE, od.image, 5U);                                                     \
        if (od_pack(&TABLE, od.image, number, before, &packed, NULL) == OD_PDO_OK) {        \
            name##_unpack(&values, before);                                                 \
            if (values.field != get(&od)) {                                                 \
                fail(#field);                                                               \
            }                                                                               \
        }                                                                                   \
    }

/** The first RPDO with an identifier is found by it, and no PDO of another one. */
static void receivers(void)
{
    uint16_t at;
    od_reset(&TABLE, od.image, 5U);
    for (at = 0U; at < TABLE.pdo_count; at++) {
        const od_pdo_t *pdo = &TABLE.pdos[at];
        od_pdo_settings_t settings;
        uint8_t result = od_pdo_settings(&TABLE, od.image, pdo->index, &settings);
        uint16_t can_id = (uint16_t)(settings.cob_id & 0x7FFU);
        uint16_t number = 0U;
        bool is_found = false;
        do {
            number = od_receiver(&TABLE, od.image, can_id, number);
            is_found = is_found || ((number > 0U) && (pdo->index == (0x1400U + number) - 1U));
        } while (number > 0U);
        if (is_found != ((result == OD_PDO_OK) && (pdo->index < 0x1800U))) {
            fail("receiver");
        }
    }
    if (od_receiver(&TABLE, od.image, 0x7FEU, 0U) != 0U) {
        fail("a receiver of nothing");
    }
}

int main(void)
{
    unsigned int turn;
    size_t at;
    size_t length;
    od_value_t value;
    od_value_t copy;
    receivers();
    /* Transmission types: at a SYNC after an event, at each third SYNC, on a remote frame, on an event. */
    if (od_is_due(0U, true, 0U) || od_is_due(0U, false, 1U) || !od_is_due(0U, true, 1U) || od_is_due(3U, true, 2U)
        || !od_is_due(3U, false, 3U) || od_is_due(240U, true, 239U) || od_is_due(241U, true, 999U)
        || od_is_due(252U, true, 9U) || od_is_due(253U, true, 0U) || !od_is_due(254U, true, 0U) || !od_is_due(255U, true, 0U)
        || od_is_due(255U, false, 9U)) {
        fail("due");
    }
    if ((od_length(&TABLE, od.image, 0x1000U, 0U, &length) == OD_OK) && (length != 4U)) {
        fail("length");
    }
    if ((od_length(&TABLE, od.image, 0x0FFFU, 0U, &length) != OD_ABORT_NO_OBJECT) || (length != 0U)) {
        fail("length of nothing");
    }
    /* A value can be copied. */
    if (od_read(&TABLE, od.image, 0x1000U, 0U, &value) == OD_OK) {
        copy = value;
        (void)memset(&value, 0xFF, sizeof(value));
        if (memcmp(od_value_bytes(&copy), &copy.held[0], copy.length) != 0) {
            fail("copy");
        }
    }
    turn = 0U;
    at = 0U;
    fill(before, sizeof(before));
    (void)memcpy(after, before, sizeof(after));
#include "frames.inc"
    (void)printf("%u %u\n", turn, (unsigned int)at);
    return 0;
}
