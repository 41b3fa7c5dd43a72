/* What is known of the machine. */
#ifndef CAROM_CPU_MACHINE_HPP
#define CAROM_CPU_MACHINE_HPP

#include "carom.h"

namespace carom::cpu {

/* Fills in the names, the cores and the memory. Where the memory is not known it is taken to be 1 GiB. */
void describe_machine(carom_device_info &info);

}

#endif
