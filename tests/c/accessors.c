/*
 * Calls the functions of a device's header, and holds what they read and write against the table: calls.inc has a line for each.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include DEVICE_HEADER

static DICTIONARY od;
static DICTIONARY before;
static uint32_t state = 1U;

static void fill(void)
{
    size_t at;
    for (at = 0U; at < sizeof(od.image); at++) {
        state = (state * 1664525U) + 1013904223U;
        od.image[at] = (uint8_t)(state >> 24);
    }
    before = od;
}

static void fail(const char *what, od_row_t row)
{
    uint16_t index = 0U;
    uint8_t sub = 0U;
    (void)od_id(&TABLE, row, &index, &sub);
    (void)printf("%s: %04Xh.%u\n", what, (unsigned int)index, (unsigned int)sub);
    exit(1);
}

/** The raw value of a row in as many bits as travel. */
static uint64_t raw(od_row_t row)
{
    uint16_t size = od_attributes(&TABLE, row)->size;
    uint64_t mask = (size < 8U) ? (((uint64_t)1U << (8U * size)) - 1U) : UINT64_MAX;
    uint64_t bits = (od_attributes(&TABLE, row)->data_type == OD_TYPE_UNSIGNED64)
        ? od_count(&TABLE, od.image, row)
        : (uint64_t)od_number(&TABLE, od.image, row);
    return bits & mask;
}

static uint64_t cut(od_row_t row, uint64_t value)
{
    uint16_t size = od_attributes(&TABLE, row)->size;
    return (size < 8U) ? (value & (((uint64_t)1U << (8U * size)) - 1U)) : value;
}

static void expect(const char *what, od_row_t row, uint64_t value)
{
    if (raw(row) != cut(row, value)) {
        fail(what, row);
    }
}

/** That nothing but the value of a row changed: no more bytes than it has, and no value of another entry that is no view. */
static void alone(const char *what, od_row_t row, size_t size)
{
    size_t changed = 0U;
    size_t at;
    size_t first = sizeof(od.image);
    size_t last = 0U;
    for (at = 0U; at < sizeof(od.image); at++) {
        if (od.image[at] != before.image[at]) {
            first = (at < first) ? at : first;
            last = at;
            changed++;
        }
    }
    if ((changed > 0U) && ((last - first) >= size)) {
        fail(what, row);
    }
}

static size_t size_of(od_row_t row)
{
    return od_attributes(&TABLE, row)->size;
}

#define TIMES (20U)

/** The random number of an entry, read; the value of another image, written; values of the type are those that came. */
#define NUMBER(get, row)                              \
    for (turn = 0U; turn < TIMES; turn++) {           \
        fill();                                       \
        expect(#get, row, (uint64_t)get(&od));        \
    }

#define SET(type, get, set, row)                      \
    for (turn = 0U; turn < TIMES; turn++) {           \
        type value;                                   \
        fill();                                       \
        value = get(&od);                             \
        fill();                                       \
        set(&od, value);                              \
        expect(#set, row, (uint64_t)value);           \
        alone(#set, row, size_of(row));               \
    }

/** What may not fit: where it is said to, it is there, else nothing has changed. */
#define TRY(type, get, set, row)                                               \
    for (turn = 0U; turn < TIMES; turn++) {                                    \
        type value;                                                            \
        fill();                                                                \
        value = get(&od);                                                      \
        fill();                                                                \
        if (set(&od, value)) {                                                 \
            alone(#set, row, 8U);                                              \
            if (get(&od) != value) {                                           \
                fail(#set, row);                                               \
            }                                                                  \
        } else if (memcmp(&od, &before, sizeof(od)) != 0) {                    \
            fail(#set, row);                                                   \
        } else if (od_attributes(&TABLE, row)->place != OD_PLACE_ALIAS) {      \
            fail(#set, row);                                                   \
        } else {                                                               \
            tried++;                                                           \
        }                                                                      \
        fill();                                                                \
        value = (type)0;                                                       \
        if (!set(&od, value) || (get(&od) != value)) {                         \
            fail(#set, row);                                                   \
        }                                                                      \
    }

#define SHOWN(type, get, row)                                                  \
    for (turn = 0U; turn < TIMES; turn++) {                                    \
        type value;                                                            \
        int64_t number;                                                        \
        bool is_shown;                                                         \
        fill();                                                                \
        is_shown = get(&od, &value);                                           \
        if (is_shown != od_get_view(&TABLE, od.image, row, &number)) {         \
            fail(#get, row);                                                   \
        }                                                                      \
        expect(#get, row, (uint64_t)value);                                    \
    }

#define SAME(get, set, row)                                                    \
    for (turn = 0U; turn < TIMES; turn++) {                                    \
        od_reset(&TABLE, od.image, 5U);                                        \
        before = od;                                                           \
        set(&od, get(&od));                                                    \
        if (memcmp(&od, &before, sizeof(od)) != 0) {                           \
            fail(#set, row);                                                   \
        }                                                                      \
    }

#define STRING(get, row)                                                       \
    {                                                                          \
        od_bytes_t text;                                                       \
        od_bytes_t other;                                                      \
        od_reset(&TABLE, od.image, 5U);                                        \
        text = get(&od);                                                       \
        other = od_get_string(&TABLE, od.image, row);                          \
        if ((text.length != other.length) || (text.bytes != other.bytes)) {    \
            fail(#get, row);                                                   \
        }                                                                      \
    }

#define SET_STRING(get, set, row)                                              \
    {                                                                          \
        static const uint8_t letters[4] = {'a', 'b', 'c', 'd'};                \
        od_bytes_t text;                                                       \
        fill();                                                                \
        if (!set(&od, letters, 2U)) {                                          \
            fail(#set, row);                                                   \
        }                                                                      \
        text = get(&od);                                                       \
        if ((text.length != 2U) || (memcmp(text.bytes, letters, 2U) != 0)) {   \
            fail(#get, row);                                                   \
        }                                                                      \
        alone(#set, row, size_of(row) + 2U);                                   \
        before = od;                                                           \
        if (set(&od, (const uint8_t *)od.image, size_of(row) + 2U)             \
            || (memcmp(&od, &before, sizeof(od)) != 0)) {                      \
            fail(#set, row);                                                   \
        }                                                                      \
    }

#define ELEMENTS(type, get, set, index)                                        \
    for (sub = 0U; sub < 256U; sub++) {                                        \
        type value = (type)0;                                                  \
        od_row_t row = 0U;                                                     \
        bool is_there = (sub > 0U) && (od_find(&TABLE, index, (uint8_t)sub, &row) == OD_OK); \
        fill();                                                                \
        if (get(&od, (uint8_t)sub, &value) != is_there) {                      \
            fail(#get, row);                                                   \
        }                                                                      \
        if (is_there) {                                                        \
            expect(#get, row, (uint64_t)value);                                \
            fill();                                                            \
            if (!set(&od, (uint8_t)sub, value)) {                              \
                fail(#set, row);                                               \
            }                                                                  \
            expect(#set, row, (uint64_t)value);                                \
            alone(#set, row, size_of(row));                                    \
        }                                                                      \
    }

int main(void)
{
    unsigned int turn = 0U;
    unsigned int sub = 0U;
    unsigned int tried = 0U;
#include "calls.inc"
    (void)printf("%u %u %u\n", turn, sub, tried);
    return 0;
}
