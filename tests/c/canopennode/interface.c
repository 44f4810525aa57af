/* The accesses of the interface, as its description has them: enough to read and write a generated dictionary in tests. */
#include <string.h>

#define OD_DEFINITION
#include "301/CO_ODinterface.h"

/* Moves the part of a value that one call is about; returns whether more is to come. */
static ODR_t next_part(OD_stream_t *stream, OD_size_t room, OD_size_t *at, OD_size_t *length) {
    const OD_size_t rest = stream->dataLength - stream->dataOffset;
    *at = stream->dataOffset;
    if (rest > room) {
        *length = room;
        stream->dataOffset += room;
        return ODR_PARTIAL;
    }
    *length = rest;
    stream->dataOffset = 0U;
    return ODR_OK;
}

ODR_t OD_readOriginal(OD_stream_t *stream, void *buf, OD_size_t count, OD_size_t *countRead) {
    OD_size_t at;
    OD_size_t length;
    ODR_t outcome;

    if ((stream == NULL) || (buf == NULL) || (countRead == NULL)) {
        return ODR_DEV_INCOMPAT;
    }
    if (stream->dataOrig == NULL) {
        return ODR_SUB_NOT_EXIST;
    }
    outcome = next_part(stream, count, &at, &length);
    (void)memcpy(buf, (const uint8_t *)stream->dataOrig + at, length);
    *countRead = length;
    return outcome;
}

ODR_t OD_writeOriginal(OD_stream_t *stream, const void *buf, OD_size_t count, OD_size_t *countWritten) {
    OD_size_t at;
    OD_size_t length;
    ODR_t outcome;

    if ((stream == NULL) || (buf == NULL) || (countWritten == NULL)) {
        return ODR_DEV_INCOMPAT;
    }
    if (stream->dataOrig == NULL) {
        return ODR_SUB_NOT_EXIST;
    }
    if (count > (stream->dataLength - stream->dataOffset)) {
        return ODR_DATA_LONG;
    }
    outcome = next_part(stream, count, &at, &length);
    (void)memcpy((uint8_t *)stream->dataOrig + at, buf, length);
    *countWritten = length;
    return outcome;
}

static ODR_t read_refused(OD_stream_t *stream, void *buf, OD_size_t count, OD_size_t *countRead) {
    (void)stream;
    (void)buf;
    (void)count;
    (void)countRead;
    return ODR_UNSUPP_ACCESS;
}

static ODR_t write_refused(OD_stream_t *stream, const void *buf, OD_size_t count, OD_size_t *countWritten) {
    (void)stream;
    (void)buf;
    (void)count;
    (void)countWritten;
    return ODR_UNSUPP_ACCESS;
}

/* By bisection, as the stack does: a list out of order does not answer. */
OD_entry_t *OD_find(OD_t *od, uint16_t index) {
    uint16_t low = 0U;
    uint16_t high = od->size;

    while (low < high) {
        const uint16_t middle = (uint16_t)((low + high) / 2U);
        if (od->list[middle].index == index) {
            return &od->list[middle];
        }
        if (od->list[middle].index < index) {
            low = (uint16_t)(middle + 1U);
        } else {
            high = middle;
        }
    }
    return NULL;
}

ODR_t OD_getSub(const OD_entry_t *entry, uint8_t subIndex, OD_IO_t *io, bool_t odOrig) {
    OD_stream_t *stream;
    uint8_t position = 0U;

    if ((entry == NULL) || (entry->odObject == NULL)) {
        return ODR_IDX_NOT_EXIST;
    }
    if (io == NULL) {
        return ODR_DEV_INCOMPAT;
    }
    stream = &io->stream;
    switch (entry->odObjectType & (uint8_t)ODT_TYPE_MASK) {
    case ODT_VAR: {
        const OD_obj_var_t *object = (const OD_obj_var_t *)entry->odObject;
        if (subIndex > 0U) {
            return ODR_SUB_NOT_EXIST;
        }
        stream->dataOrig = object->dataOrig;
        stream->attribute = object->attribute;
        stream->dataLength = object->dataLength;
        break;
    }
    case ODT_ARR: {
        const OD_obj_array_t *object = (const OD_obj_array_t *)entry->odObject;
        if (subIndex >= entry->subEntriesCount) {
            return ODR_SUB_NOT_EXIST;
        }
        if (subIndex == 0U) {
            stream->dataOrig = object->dataOrig0;
            stream->attribute = object->attribute0;
            stream->dataLength = 1U;
        } else {
            uint8_t *const first = (uint8_t *)object->dataOrig;
            stream->dataOrig = (first == NULL) ? NULL : &first[object->dataElementSizeof * (OD_size_t)(subIndex - 1U)];
            stream->attribute = object->attribute;
            stream->dataLength = object->dataElementLength;
        }
        break;
    }
    case ODT_REC: {
        const OD_obj_record_t *object = (const OD_obj_record_t *)entry->odObject;
        while ((position < entry->subEntriesCount) && (object[position].subIndex != subIndex)) {
            position++;
        }
        if (position == entry->subEntriesCount) {
            return ODR_SUB_NOT_EXIST;
        }
        stream->dataOrig = object[position].dataOrig;
        stream->attribute = object[position].attribute;
        stream->dataLength = object[position].dataLength;
        break;
    }
    default:
        return ODR_DEV_INCOMPAT;
    }
    if ((entry->extension == NULL) || odOrig) {
        io->read = OD_readOriginal;
        io->write = OD_writeOriginal;
        stream->object = NULL;
    } else {
        io->read = (entry->extension->read != NULL) ? entry->extension->read : read_refused;
        io->write = (entry->extension->write != NULL) ? entry->extension->write : write_refused;
        stream->object = entry->extension->object;
    }
    stream->dataOffset = 0U;
    stream->index = entry->index;
    stream->subIndex = subIndex;
    return ODR_OK;
}

uint32_t OD_getSDOabCode(ODR_t returnCode) {
    static const uint32_t codes[ODR_COUNT] = {
        0x00000000UL, 0x05040005UL, 0x06010000UL, 0x06010001UL, 0x06010002UL, 0x06020000UL, 0x06040041UL,
        0x06040042UL, 0x06040043UL, 0x06040047UL, 0x06060000UL, 0x06070010UL, 0x06070012UL, 0x06070013UL,
        0x06090011UL, 0x06090030UL, 0x06090031UL, 0x06090032UL, 0x06090036UL, 0x060A0023UL, 0x08000000UL,
        0x08000020UL, 0x08000021UL, 0x08000022UL, 0x08000023UL, 0x08000024UL,
    };
    const int32_t code = (int32_t)returnCode;

    return ((code < 0) || (code >= (int32_t)ODR_COUNT)) ? codes[ODR_DEV_INCOMPAT] : codes[code];
}
