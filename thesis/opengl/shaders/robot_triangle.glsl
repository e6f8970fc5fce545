// What the robot's vertex and fragment shaders agree on.

// Nothing is drawn nearer than this; near over depth is what the depth buffer holds.
const float kNear_m = 1.0e-4;
