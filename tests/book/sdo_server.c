/*
 * An SDO server, expedited and segmented. The CAN driver calls it with the data of each frame
 * 600h + node-ID, and sends the answer as 580h + node-ID. In place of NULL, an application says
 * whether the device is unlocked, hears of new values, and stores parameters on command (1010h, 1011h);
 * without it, the answer to these commands is that nothing is stored (0800 0020h).
 */
#include "valve_od.h"

static valve_od_t od;
static enum { IDLE, UPLOAD, DOWNLOAD } transfer = IDLE;
static uint16_t index;
static uint8_t sub, toggle;
static size_t length, announced, at; /* of the value, by the client, of the transfer */
static uint8_t buffer[VALVE_OD_LARGEST_VALUE];

static void copy(uint8_t *to, const uint8_t *from, size_t count) {
    while (count-- > 0U) {
        to[count] = from[count];
    }
}

static uint32_t begin_upload(uint8_t answer[8]) {
    od_value_t value;
    uint32_t code = valve_od_upload(&od, index, sub, &value, NULL);
    length = value.length;
    if ((length >= 1U) && (length <= 4U)) {
        answer[0] = (uint8_t)(0x43U | ((4U - length) << 2));
        copy(&answer[4], od_value_bytes(&value), length);
    } else if (code == OD_OK) {
        answer[0] = 0x41U;
        od_put_u32(&answer[4], (uint32_t)length);
        copy(buffer, od_value_bytes(&value), length);
        transfer = UPLOAD;
    }
    return code;
}

static uint32_t upload_segment(uint8_t answer[8]) {
    size_t rest = length - at;
    size_t count = (rest < 7U) ? rest : 7U;
    answer[0] = (uint8_t)(toggle | ((7U - count) << 1) | ((rest <= 7U) ? 1U : 0U));
    copy(&answer[1], &buffer[at], count);
    at += count;
    transfer = (rest <= 7U) ? IDLE : UPLOAD;
    return OD_OK;
}

static uint32_t begin_download(const uint8_t request[8], uint8_t answer[8]) {
    od_row_t row = 0U;
    uint32_t code = od_find(&valve_od_table, index, sub, &row);
    const od_attributes_t *entry = od_attributes(&valve_od_table, row);
    bool has_length = (request[0] & 1U) != 0U;
    answer[0] = 0x60U;
    if ((code == OD_OK) && ((request[0] & 2U) != 0U)) {
        length = has_length ? (4U - ((request[0] >> 2) & 3U)) : ((entry->size < 4U) ? entry->size : 4U);
        code = valve_od_write(&od, index, sub, &request[4], length, NULL);
    } else if (code == OD_OK) {
        announced = has_length ? od_get_u32(&request[4]) : 0U;
        length = has_length ? announced : entry->size;
        transfer = DOWNLOAD;
        code = ((entry->flags & OD_FLAG_WRITE) == 0U) ? OD_ABORT_READ_ONLY
            : ((length > entry->size) ? OD_ABORT_TOO_LONG : OD_OK);
    }
    return code;
}

static uint32_t download_segment(const uint8_t request[8], uint8_t answer[8]) {
    size_t count = 7U - ((request[0] >> 1) & 7U);
    uint32_t code = (count > (length - at)) ? OD_ABORT_TOO_LONG : OD_OK;
    answer[0] = (uint8_t)(0x20U | toggle);
    if (code == OD_OK) {
        copy(&buffer[at], &request[1], count);
        at += count;
    }
    if ((code == OD_OK) && ((request[0] & 1U) != 0U)) {
        transfer = IDLE;
        code = (at < announced) ? OD_ABORT_TOO_SHORT : valve_od_write(&od, index, sub, buffer, at, NULL);
    }
    return code;
}

void sdo_start(uint8_t node_id) {
    valve_od_reset(&od, node_id);
}

/** Answers a request; false for an abort, which has no answer. */
bool sdo_answer(const uint8_t request[8], uint8_t answer[8]) {
    uint8_t kind = request[0] >> 5; /* 0 and 3: a segment */
    bool is_segment = (transfer != IDLE) && (kind == ((transfer == DOWNLOAD) ? 0U : 3U));
    uint32_t code = 0x05040001UL; /* an unknown command */
    od_put_u64(answer, 0U);
    if (is_segment && ((request[0] & 0x10U) != toggle)) {
        code = 0x05030000UL; /* the toggle bit */
    } else if (is_segment) {
        code = (transfer == UPLOAD) ? upload_segment(answer) : download_segment(request, answer);
        toggle ^= 0x10U;
    } else {
        transfer = IDLE;
        toggle = 0U;
        at = 0U;
        index = od_get_u16(&request[1]);
        sub = request[3];
        code = (kind == 1U) ? begin_download(request, answer) : ((kind == 2U) ? begin_upload(answer) : code);
    }
    if (!is_segment || (code != OD_OK)) {
        od_put_u16(&answer[1], index);
        answer[3] = sub;
    }
    if (code != OD_OK) {
        answer[0] = 0x80U;
        od_put_u32(&answer[4], code);
        transfer = IDLE;
    }
    return kind != 4U;
}
