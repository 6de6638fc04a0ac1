// The camera that a hand moves: where it is, what it turns about, and which way is up. World space.
"use strict";

const add = (a, b) => a.map((x, i) => x + b[i]);
const subtract = (a, b) => a.map((x, i) => x - b[i]);
const times = (a, factor) => a.map(x => x * factor);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const lengthOf = a => Math.hypot(...a);
const normalized = a => times(a, 1 / lengthOf(a));

// Turns a vector about an axis of unit length, by the right hand (Rodrigues).
function turned(v, axis, angle) {
    const cosine = Math.cos(angle);
    return add(add(times(v, cosine), times(cross(axis, v), Math.sin(angle))),
               times(axis, dot(axis, v) * (1 - cosine)));
}

class Orbit {
    // `direction` is of unit length; `distance` is that of the pivot, along it.
    constructor(position, direction, up, distance) {
        this.position = position;
        this.pivot = add(position, times(direction, distance));
        this.up = normalized(up);
    }

    get direction() { return normalized(subtract(this.pivot, this.position)); }
    get distance() { return lengthOf(subtract(this.pivot, this.position)); }
    get right() { return normalized(cross(this.direction, this.up)); }

    // Angles in radians: to the right, and up. It stops short of the poles.
    turn(right, up) {
        const arm = turned(subtract(this.position, this.pivot), this.up, -right);
        const toPole = Math.acos(Math.min(Math.max(dot(normalized(arm), this.up), -1), 1));
        const margin = 0.01;
        const angle = Math.min(Math.max(up, toPole - Math.PI + margin), toPole - margin);
        const axis = normalized(cross(normalized(times(arm, -1)), this.up));
        this.position = add(this.pivot, turned(arm, axis, -angle));
    }

    // What the picture's width shows at the pivot's distance.
    widthShown(fovDegrees) {
        return 2 * this.distance * Math.tan(fovDegrees * Math.PI / 360);
    }

    // Shares of the picture's width, which shows `width`: what is under the pointer at the pivot's distance stays under it.
    pan(right, up, width) {
        const imageUp = cross(this.right, this.direction);
        const move = add(times(this.right, -right * width), times(imageUp, -up * width));
        this.position = add(this.position, move);
        this.pivot = add(this.pivot, move);
    }

    // Below 1: nearer.
    dolly(factor) {
        this.position = subtract(this.pivot, times(subtract(this.pivot, this.position), factor));
    }

    lookAt(point) {
        this.pivot = point;
    }

    // As options of a render.
    options() {
        return {"camera-position": this.position, "look-at": this.pivot, "up": this.up};
    }
}
