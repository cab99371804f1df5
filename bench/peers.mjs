// Skia on the CPU (@napi-rs/canvas) and resvg (@resvg/resvg-js) as a peer process: docs/benchmarks.md has the protocol.
// node peers.mjs FOLDER skia|resvg: the folder holds node_modules with the package.

import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';
import {createRequire} from 'node:module';

const require = createRequire(path.resolve(process.argv[2] ?? '.', 'peers.mjs'));

/** CPU milliseconds of one call: user and system, all threads. */
function cpuTime(work) {
    const start = process.cpuUsage();
    work();
    const {user, system} = process.cpuUsage(start);
    return (user + system) / 1000;
}

const joinOf = join => join === undefined || join === 'miter-clip' ? 'miter' : join;

/** The deviation of a blur that a picture as a whole has; 0 where it has no filter. */
function blurOf(text) {
    const filters = [...text.matchAll(/<filter\b[^>]*>(.*?)<\/filter>/gs)];
    if (filters.length === 0)
        return 0;
    const blur = filters[0][1].match(/^\s*<feGaussianBlur\b[^>]*\bstdDeviation="([\d.]+)[^>]*\/>\s*$/);
    if (filters.length !== 1 || !blur)
        throw new Error('of filters, only one blur is drawn');
    return Number(blur[1]);
}

/** Skia draws the paths of our scene on one canvas. */
class Skia {
    constructor(package_) {
        this.package = package_;
    }

    load({file}) {
        this.loaded = this.read(file);
    }

    read(file) {
        const text = fs.readFileSync(file, 'utf8');
        const items = [...text.matchAll(/<(path|g|\/g)\b([^>]*)>/g)].map(([, tag, attributes]) => {
            const of = Object.fromEntries([...attributes.matchAll(/([\w-]+)="([^"]*)"/g)].map(m => [m[1], m[2]]));
            if (tag === 'g' && of.opacity !== undefined)
                throw new Error('a canvas has no groups with an opacity');
            return tag === 'path' ? this.itemOf(of) : null;
        }).filter(Boolean);
        return {items, blur: blurOf(text)};
    }

    itemOf(of) {
        const stroked = of.fill === 'none';
        const numbers = (of.transform ?? 'translate(0 0)').match(/[-+.\de]+(?=[ )])/g).map(Number);
        return {
            outline: new this.package.Path2D(of.d),
            transform: numbers.length === 2 ? [1, 0, 0, 1, ...numbers] : numbers,
            rule: of['fill-rule'] ?? 'nonzero',
            paint: stroked ? of.stroke : of.fill,
            alpha: Number(of[stroked ? 'stroke-opacity' : 'fill-opacity'] ?? 1),
            stroke: stroked && {
                lineWidth: Number(of['stroke-width'] ?? 1),
                lineCap: of['stroke-linecap'] ?? 'butt',
                lineJoin: joinOf(of['stroke-linejoin']),
                miterLimit: Number(of['stroke-miterlimit'] ?? 4),
                lineDashOffset: Number(of['stroke-dashoffset'] ?? 0),
                dashes: (of['stroke-dasharray'] ?? '').split(' ').filter(Boolean).map(Number),
            },
        };
    }

    draw(view) {
        this.prepareCanvas(view);
        return cpuTime(() => this.drawOn(this.loaded, view));
    }

    cold({file}, view) {
        this.prepareCanvas(view);
        return cpuTime(() => this.drawOn(this.read(file), view));
    }

    prepareCanvas({width, height}) {
        if (this.canvas?.width !== width || this.canvas?.height !== height) {
            this.canvas = this.package.createCanvas(width, height);
            this.context = this.canvas.getContext('2d');
            this.layer = this.package.createCanvas(width, height);
        }
    }

    drawOn({items, blur}, {width, height, matrix}) {
        this.drawItems(items, blur > 0 ? this.layer.getContext('2d') : this.context, width, height, matrix);
        if (blur > 0) {
            this.context.clearRect(0, 0, width, height);
            this.context.filter = `blur(${blur * Math.hypot(matrix[0], matrix[1])}px)`;
            this.context.drawImage(this.layer, 0, 0);
            this.context.filter = 'none';
        }
        this.context.getImageData(0, 0, 1, 1);  // drawing is put off until pixels are wanted
    }

    drawItems(items, context, width, height, matrix) {
        context.setTransform(1, 0, 0, 1, 0, 0);
        context.clearRect(0, 0, width, height);
        for (const item of items) {
            context.setTransform(...matrix);
            context.transform(...item.transform);
            context.globalAlpha = item.alpha;
            if (item.stroke) {
                const {dashes, ...style} = item.stroke;
                context.strokeStyle = item.paint;
                Object.assign(context, style);
                context.setLineDash(dashes);
                context.stroke(item.outline);
            } else {
                context.fillStyle = item.paint;
                context.fill(item.outline, item.rule);
            }
        }
        context.setTransform(1, 0, 0, 1, 0, 0);
        context.globalAlpha = 1;
    }

    png(view) {
        this.draw(view);
        return this.canvas.toBuffer('image/png');
    }
}

/** resvg has no view of its own: the file is parsed inside an svg element that turns it, outside the clock. */
class Resvg {
    constructor(package_) {
        this.package = package_;
    }

    load({file, width, height}) {
        this.text = fs.readFileSync(file, 'utf8');
        this.size = [width, height];
    }

    parse(text, [pictureWidth, pictureHeight], {width, height, matrix}) {
        const root = text.match(/<svg\b[^>]*>/);
        const tag = root[0].replace(/\s(width|height|x|y)\s*=\s*("[^"]*"|'[^']*')/g, '')
            .replace('<svg', `<svg width="${pictureWidth}" height="${pictureHeight}"`);
        const turned = text.slice(0, root.index) +
            `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}">` +
            `<g transform="matrix(${matrix.join(' ')})">` + tag + text.slice(root.index + root[0].length) + '</g></svg>';
        return new this.package.Resvg(turned, {font: {loadSystemFonts: turned.includes('<text')}});
    }

    draw(view) {
        const tree = this.parse(this.text, this.size, view);
        return cpuTime(() => tree.render());
    }

    cold({file, width, height}, view) {
        return cpuTime(() => this.parse(fs.readFileSync(file, 'utf8'), [width, height], view).render());
    }

    png(view) {
        return this.parse(this.text, this.size, view).render().asPng();
    }
}

const engines = {};

function offer(name, takes, packageName, Type) {
    try {
        engines[name] = new Type(require(packageName));
        const {version} = JSON.parse(fs.readFileSync(path.join(packageFolder(packageName), 'package.json')));
        console.log(`engine ${name} ${takes} ${packageName} ${version} on the CPU`);
    } catch (error) {
        console.log(`missing ${name}: missing, no ${packageName} in node_modules of the folder given.`);
    }
}

function packageFolder(name) {
    return require.resolve.paths(name).map(folder => path.join(folder, name)).find(fs.existsSync);
}

function viewOf(words) {
    const [width, height, ...matrix] = words.splice(0, 8).map(Number);
    return {width, height, matrix};
}

/** Bytes of the largest resident set so far. */
function peakBytes() {
    return Number(fs.readFileSync('/proc/self/status', 'utf8').match(/VmHWM:\s*(\d+)/)[1]) * 1024;
}

function answer(line) {
    const [verb, name, ...words] = line.split(' ');
    if (verb === 'peak')
        return peakBytes();
    const engine = engines[name];
    const [width, height] = verb === 'load' || verb === 'cold' ? words.splice(0, 2).map(Number) : [];
    const view = verb === 'load' ? null : viewOf(words);
    const file = words.join(' ');
    switch (verb) {
        case 'load': engine.load({width, height, file}); return '';
        case 'cold': return engine.cold({width, height, file}, view);
        case 'draw': return engine.draw(view);
        case 'picture': fs.writeFileSync(file, engine.png(view)); return '';
    }
    throw new Error(`${verb} is no request`);
}

if (process.argv[3] === 'skia')
    offer('skia', 'paths', '@napi-rs/canvas', Skia);
else
    offer('resvg', 'file', '@resvg/resvg-js', Resvg);
console.log('ready');
for await (const line of readline.createInterface({input: process.stdin})) {
    try {
        console.log(`ok ${answer(line)}`);
    } catch (error) {
        console.log(`error ${String(error.message).split('\n')[0]}`);
    }
}
