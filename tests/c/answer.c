/*
 * The dictionary of one device that answers requests. DEVICE_HEADER is its header, TABLE its table, SIZE
 * the bytes of its image.
 */
#include "answer.h"

#include DEVICE_HEADER

#define LOCKED (0U)
#define UNLOCKED (1U)

static uint8_t image[(SIZE > 0UL) ? SIZE : 1UL];

/* The application: it notes who asks it what. */

static uint8_t calls[4096];
static uint16_t call_count;
static bool unlocked;
static uint32_t veto;

static void note(uint8_t kind, od_row_t row)
{
    if (((size_t)call_count + 1U) * 3U <= sizeof(calls)) {
        calls[call_count * 3U] = kind;
        od_put_u16(&calls[(call_count * 3U) + 1U], row);
    }
    call_count++;
}

static bool is_unlocked(void *context)
{
    return *(const bool *)context;
}

static void refresh(void *context, od_row_t row)
{
    (void)context;
    note(0U, row);
}

static uint32_t accept(void *context, od_row_t row, const uint8_t *data, size_t length)
{
    (void)context;
    (void)data;
    (void)length;
    note(1U, row);
    return veto;
}

static uint32_t command(void *context, uint16_t index, uint8_t sub)
{
    (void)context;
    note((index == 0x1010U) ? 3U : 4U, sub);
    return (veto == OD_OK) ? OD_OK : OD_ABORT_HARDWARE;
}

static void changed(void *context, od_row_t row)
{
    (void)context;
    note(2U, row);
}

static const od_application_t application = {&unlocked, is_unlocked, refresh, accept, command, changed, NULL, NULL};

size_t answer(const uint8_t *request, size_t length, uint8_t *bytes)
{
    uint8_t operation = request[0];
    uint16_t index = (length >= 3U) ? od_get_u16(&request[1]) : 0U;
    uint8_t sub = (length >= 4U) ? request[3] : 0U;
    const uint8_t *data = &request[(length >= 5U) ? 5U : length];
    size_t data_length = (length >= 5U) ? (length - 5U) : 0U;
    uint32_t code = 0U;
    od_value_t value = {NULL, 0U, {0U}};
    uint8_t frame[8] = {0U};
    uint8_t frame_length = 0U;
    od_received_t received = {false, OD_NONE, OD_OK};
    const od_constraint_t *constraint;
    const od_region_t *region;
    uint32_t layout;
    uint16_t row = 0U;
    size_t at;
    call_count = 0U;
    /* The fourth byte after the operation says how the application is: unlocked, and whether it refuses. */
    unlocked = (length >= 5U) && ((request[4] & 1U) != 0U);
    veto = ((length >= 5U) && ((request[4] & 2U) != 0U)) ? OD_ABORT_LOCAL_CONTROL : OD_OK;
    switch (operation) {
    case 'r':
        code = od_read(&TABLE, image, index, sub, &value);
        break;
    case 'u':
        code = od_upload(&TABLE, image, index, sub, &value, &application);
        break;
    case 'w':
        code = od_write(&TABLE, image, index, sub, data, data_length, &application);
        break;
    case 'c':
        code = od_write_consistent(&TABLE, image, index, sub, data, data_length, &application);
        break;
    case 'd':
        code = od_download_domain(&TABLE, image, index, sub, 0U, data, data_length, true, &application);
        break;
    case 'l':
        at = sizeof(frame);
        code = od_upload_domain(&TABLE, index, sub, 0U, frame, &at, &application);
        break;
    case 'p':
        code = od_pack(&TABLE, image, index, frame, &frame_length, &application);
        value.held = frame;
        value.length = frame_length;
        break;
    case 'n':
        code = od_unpack(&TABLE, image, index, data, data_length, &received, &application);
        frame[0] = received.too_long ? 1U : 0U;
        od_put_u16(&frame[1], received.refused);
        od_put_u32(&frame[3], received.code);
        value.held = frame;
        value.length = 7U;
        break;
    case 'f':
        od_reset(&TABLE, image, sub);
        break;
    case 'g':
        od_reset_stored(&TABLE, image, (uint8_t)index, sub);
        break;
    case 's':
        /* What the device itself may have there. */
        for (at = 0U; at < data_length; at++) {
            image[((size_t)sub << 16) + index + at] = data[at];
        }
        break;
    case 'k':
        if (od_id(&TABLE, index, &row, &frame[2])) {
            od_put_u16(frame, row);
            value.held = frame;
            value.length = 3U;
        }
        break;
    case 'R':
        /* The application byte says whether the number is that of the layout. */
        region = od_stored(&TABLE, sub);
        layout = (region != NULL) ? region->layout : 0U;
        code = od_restore(&TABLE, image, sub, unlocked ? layout : (layout + 1U), data, data_length) ? 0U : 1U;
        break;
    case 'C':
        code = od_correct_stored(&TABLE, image, (uint8_t)index, sub, &row) ? ((uint32_t)row + 1U) : 0U;
        break;
    case 'i':
        value.held = image;
        value.length = TABLE.image_size;
        break;
    case 'b':
        constraint = od_broken_constraint(&TABLE, image);
        code = (constraint != NULL) ? (uint32_t)(constraint - TABLE.constraints) + 1U : 0U;
        break;
    default:
        code = OD_ABORT_GENERAL;
        break;
    }
    if ((code != OD_OK) && (operation != 'n')) {
        value.length = 0U;
    }
    od_put_u32(bytes, code);
    od_put_u16(&bytes[4], call_count);
    for (at = 0U; at < (size_t)call_count * 3U; at++) {
        bytes[6U + at] = calls[at];
    }
    for (at = 0U; at < value.length; at++) {
        bytes[6U + ((size_t)call_count * 3U) + at] = od_value_bytes(&value)[at];
    }
    return 6U + ((size_t)call_count * 3U) + value.length;
}
