// Two numbers below 65536 in one: a pixel's column, and its row above.
ivec2 unpack(uint both) { return ivec2(both & 0xFFFFu, both >> 16); }
uint pack(ivec2 v) { return uint(v.x) | uint(v.y) << 16; }
