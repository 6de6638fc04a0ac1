// The step of an integrator, by the kinds of requests. It defines three functions, which find `request` as it is where
// nothing follows, but for its ray:

void shadeHit(const Answer answer);   // the nearest hit is known
void lightVertex(const Answer answer); // its turn at a vertex
void addLight(const Answer answer);   // the shadow ray has arrived, or not

void nextAfterNearest(const Answer answer) {
    request.kind = requestEnd;
    if (originsMeetGlass() && path.key.depth == 0u)
        passOnWay(answer);
    else
        shadeHit(answer);
}

void nextAtVertex(const Answer answer) {
    request.kind = requestEnd;
    lightVertex(answer);
}

void nextAfterVisibility(const Answer answer) {
    request.kind = requestEnd;
    addLight(answer);
}
