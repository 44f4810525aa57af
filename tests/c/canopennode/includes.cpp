// The headers can be read by C++.
#include "301/CO_ODinterface.h"
#include "OD.h"
#include "OD_extension.h"
#include "OD_types.h"

int main() {
    return (OD->size > 0U) ? 0 : 1;
}
