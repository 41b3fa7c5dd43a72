/* Stands for carom_peer_chipmunk.c where Chipmunk is not installed, and with CHIPMUNK=no.
 * SPDX-License-Identifier: MIT */
#include "carom_peer.h"

const struct peer peer_chipmunk = {
	.name = "Chipmunk",
	.settings = "not in this build; to have it: tools/bootstrap --peers (on Debian libchipmunk-dev), then make",
};
