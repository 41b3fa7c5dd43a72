/* Stands for carom_peer_box2d.cpp where Box2D is not installed, and with BOX2D=no.
 * SPDX-License-Identifier: MIT */
#include "carom_peer.h"

const struct peer peer_box2d = {
	.name = "Box2D",
	.settings = "not in this build; to have it: tools/bootstrap --peers (on Debian libbox2d-dev), then make",
};
