/* Requests on the standard input and answers on the standard output, each after its length in 4 bytes. */
#include <stdio.h>

#include "answer.h"

static int number(size_t *length)
{
    uint8_t bytes[4];
    if (fread(bytes, 1U, sizeof(bytes), stdin) != sizeof(bytes)) {
        return 0;
    }
    *length = (size_t)bytes[0] | ((size_t)bytes[1] << 8) | ((size_t)bytes[2] << 16) | ((size_t)bytes[3] << 24);
    return 1;
}

int main(void)
{
    static uint8_t request[4096];
    static uint8_t bytes[LONGEST_ANSWER];
    size_t length;
    while (number(&length)) {
        uint8_t head[4];
        if ((length == 0U) || (length > sizeof(request)) || (fread(request, 1U, length, stdin) != length)) {
            return 1;
        }
        length = answer(request, length, bytes);
        head[0] = (uint8_t)(length & 0xFFU);
        head[1] = (uint8_t)((length >> 8) & 0xFFU);
        head[2] = (uint8_t)((length >> 16) & 0xFFU);
        head[3] = 0U;
        if ((fwrite(head, 1U, 4U, stdout) != 4U) || (fwrite(bytes, 1U, length, stdout) != length)) {
            return 1;
        }
    }
    return (fflush(stdout) == 0) ? 0 : 1;
}
