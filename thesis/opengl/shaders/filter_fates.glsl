// PixelFate of types/obstacle_image.hpp.
const uint kObstacle = 0u;
const uint kNoReading = 1u;
const uint kRobot = 2u;
const uint kEnvironment = 3u;
const uint kPadding = 4u;
const uint kFlyingPatch = 5u;
const uint kOutsideRegion = 6u;
const uint kSpeckle = 8u;
const uint kFates = 9u;

const uint kNoLink = 0u;
const uint kEnvironmentLink = 0xFFFFu;

bool is_evaluated(uint link) { return link != kNoLink && link != kEnvironmentLink; }
