// A scene in which each layer has something to see: a floor and a wall with texture coordinates, balls, a lamp, and a ball
// that catches shadows alone.
import {writeFileSync} from "node:fs";

const floor = `v -2 -1 -3\nv 2 -1 -3\nv 2 -1 2\nv -2 -1 2\nv -2 2 -3\nv 2 2 -3
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/1 3/2 2/3 1/4\nf 1/1 2/2 6/3 5/4\n`;

export function room({albedo = [0.8, 0.4, 0.2], camera = {}, settings = {}} = {}) {
    return {
        camera: {type: "perspective", position: [0.5, 0.5, 6], target: [0, 0, 0], horizontalFov: 50, width: 96, height: 64, ...camera},
        materials: {clay: {type: "diffuse", albedo}, wall: {type: "diffuse", albedo: [0.6, 0.7, 0.8]},
                    catcher: {type: "shadowCatcher"}, lamp: {type: "diffuse", albedo: 0.5, emission: [30, 30, 25]}},
        meshes: [{file: "floor.obj", material: "wall"}],
        spheres: [{centre: [0, 0, 0], radius: 0.8, material: "clay"},
                  {centre: [-1.2, -0.6, 0.8], radius: 0.4, material: "clay"},
                  {centre: [1.4, -0.6, 0.5], radius: 0.4, material: "catcher"},
                  {centre: [0.5, 3, 1], radius: 0.3, material: "lamp"}],
        lights: [{type: "point", position: [2, 3, 5], power: 900}],
        settings: {integrator: "path", spp: 8, ...settings},
    };
}

// Stores it, as room.json unless it has another name.
export function storeRoom(folder, changes = {}, name = "room.json") {
    writeFileSync(folder.of("floor.obj"), floor);
    writeFileSync(folder.of(name), JSON.stringify(room(changes)));
    return name;
}
