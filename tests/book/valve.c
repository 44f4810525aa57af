#include "valve_od.h"

static valve_od_t od;

static bool is_unlocked(void *context)
{
    (void)context;
    return false;
}

static void changed(void *context, od_row_t row)
{
    (void)context;
    if (row == VALVE_ENTRY_SET_PRESSURE) {
        /* move the valve to valve_get_set_pressure(&od), in 0.1 bar */
    }
}

static const od_application_t application = {.is_unlocked = is_unlocked, .changed = changed};

void start(uint8_t node_id)
{
    valve_od_reset(&od, node_id);
    valve_set_actual_pressure(&od, VALVE_SPECIAL_ACTUAL_PRESSURE_SENSOR_BROKEN);
}

/** What an SDO server does with a download: OD_OK, or the abort code that it sends. */
uint32_t download(uint16_t index, uint8_t sub, const uint8_t *data, size_t length)
{
    return valve_od_write(&od, index, sub, data, length, &application);
}
