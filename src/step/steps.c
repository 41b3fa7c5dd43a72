#include "step/step.h"

const carom_step *const carom_steps[] = {&carom_step_first_impact, &carom_step_events, &carom_step_contacts};
const size_t carom_step_count = sizeof carom_steps / sizeof *carom_steps;
