// The links that have pixels in the robot image; the others are passed over.
uniform uint link_count;
layout(std430) readonly buffer LinkPixels { uint link_pixels[]; };

// The first of link, link + stride, ... that is visible; link_count or more if none is.
uint visible_from(uint link, uint stride) {
  while (link < link_count && link_pixels[link] == 0u) link += stride;
  return link;
}
